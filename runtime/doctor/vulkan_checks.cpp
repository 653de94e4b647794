#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/doctor/checks.h"
#include "runtime/doctor/probe.h"
#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/context.h"
#include "runtime/vulkan/driver_environment.h"
#include "runtime/vulkan/requirements.h"

namespace gazeloop::doctor {
namespace {

constexpr const char* kDriverRemedy =
    "install a Vulkan 1.3 driver (Debian without a GPU: apt-get install mesa-vulkan-drivers); "
    "VK_DRIVER_FILES and VK_ICD_FILENAMES, if set, must name an existing one";

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

Finding check_loader(const vk::raii::Context& context) {
    const std::uint32_t version = context.enumerateInstanceVersion();
    const bool enough = version >= VK_API_VERSION_1_3;
    return {.check = "vulkan.loader",
            .verdict = enough ? Verdict::Ok : Verdict::Failure,
            .found = "Vulkan loader " + version_text(version),
            .remedy = enough ? "" : "install a Vulkan loader 1.3 or newer (Debian: libvulkan1)",
            .facts = {{"version", version_text(version)}},
            .stops_loop = !enough};
}

Finding check_validation(const vk::raii::Context& context, bool wanted) {
    const auto layers = context.enumerateInstanceLayerProperties();
    const auto layer = std::ranges::find_if(layers, [](const vk::LayerProperties& one) {
        return std::string_view(one.layerName.data()) == vulkan::kValidationLayer;
    });
    if (layer != layers.end()) {
        return {.check = "vulkan.validation",
                .found = fmt::format("{} {}", vulkan::kValidationLayer,
                                     version_text(layer->specVersion)),
                .facts = {{"installed", true}}};
    }
    return {.check = "vulkan.validation",
            .verdict = wanted ? Verdict::Failure : Verdict::NotApplicable,
            .found = fmt::format("{} is not installed{}", vulkan::kValidationLayer,
                                 wanted ? ", but vulkan.validation is on" : " (for developers)"),
            .remedy = wanted ? "apt-get install vulkan-validationlayers" : "",
            .facts = {{"installed", false}},
            .stops_loop = wanted};
}

Finding describe_device(const vk::raii::PhysicalDevice& device, std::size_t index) {
    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const vk::PhysicalDeviceProperties& properties =
        chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    nlohmann::json requirements = nlohmann::json::object();
    for (const vulkan::DeviceRequirement& requirement : vulkan::device_requirements(device)) {
        requirements[requirement.name] = requirement.met;
    }
    const std::string lacks = vulkan::lacking(device);
    return {.check = fmt::format("vulkan.device.{}", index),
            .verdict = lacks.empty() ? Verdict::Ok : Verdict::Warning,
            .found = fmt::format("{}: {}, Vulkan {}, driver {} {}; {}",
                                 properties.deviceName.data(), vk::to_string(properties.deviceType),
                                 version_text(properties.apiVersion), driver.driverName.data(),
                                 driver.driverInfo.data(),
                                 lacks.empty() ? "has all that is needed" : "lacks " + lacks),
            .remedy = lacks.empty() ? "" : "update its driver, if this device is to render",
            .facts = {{"name", properties.deviceName.data()},
                      {"type", vk::to_string(properties.deviceType)},
                      {"api_version", version_text(properties.apiVersion)},
                      {"driver", driver.driverName.data()},
                      {"driver_info", driver.driverInfo.data()},
                      {"requirements", requirements}}};
}

Finding describe_choice(const vulkan::Context& context) {
    const bool software =
        context.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    return {.check = "vulkan.choice",
            .verdict = software ? Verdict::Warning : Verdict::Ok,
            .found = fmt::format("{} is what the loop takes{}", context.device_name(),
                                 software ? ": it renders on the processor, not real time" : ""),
            .remedy = software ? "use a machine with a GPU, or a small picture (--set "
                                 "render.scale=0.15)"
                               : "",
            .facts = {{"device", context.device_name()},
                      {"driver", context.driver()},
                      {"software", software}}};
}

Finding check_gpu_clock(const vulkan::Context& context) {
    Finding finding{.check = "vulkan.clock"};
    const auto unrelated = [&](std::string_view why) {
        finding.verdict = Verdict::Warning;
        finding.found = fmt::format(
            "GPU times cannot be related to CLOCK_MONOTONIC ({}): the report's GPU "
            "rows stay unknown",
            why);
        finding.remedy = "use a driver with VK_EXT_calibrated_timestamps (Mesa's have it)";
        return finding;
    };
    if (!context.has_calibrated_timestamps()) {
        return unrelated("no VK_EXT_calibrated_timestamps");
    }
    const auto domains = context.physical().getCalibrateableTimeDomainsEXT();
    std::vector<std::string> names;
    names.reserve(domains.size());
    for (const vk::TimeDomainEXT domain : domains) {
        names.push_back(vk::to_string(domain));
    }
    finding.facts["domains"] = names;
    if (!vulkan::GpuClock::relates(domains)) {
        return unrelated(fmt::format("time domains: {}", fmt::join(names, ", ")));
    }
    constexpr int kCalibrations = 100;
    std::uint64_t best_ns = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t worst_ns = 0;
    for (int i = 0; i < kCalibrations; ++i) {
        const std::uint64_t deviation_ns = vulkan::GpuClock(context).max_deviation_ns();
        best_ns = std::min(best_ns, deviation_ns);
        worst_ns = std::max(worst_ns, deviation_ns);
    }
    const double period_ns = context.timestamp_period_ns();
    finding.found = fmt::format(
        "GPU ticks of {} ns, related to CLOCK_MONOTONIC within {} to {} ns "
        "({} calibrations); domains {}",
        period_ns, best_ns, worst_ns, kCalibrations, fmt::join(names, ", "));
    finding.facts.update({{"timestamp_period_ns", period_ns},
                          {"least_deviation_ns", best_ns},
                          {"greatest_deviation_ns", worst_ns}});
    return finding;
}

void probe_vulkan(const VulkanChecks& asked, ProbeReport& report) {
    report.step("loading the Vulkan loader");
    const vk::raii::Context context;
    report.add(check_loader(context));
    report.step("listing Vulkan layers");
    report.add(check_validation(context, asked.validation));
    report.step("loading the Vulkan drivers");
    const vk::ApplicationInfo application("gazeloop doctor", 1, "gazeloop", 1, VK_API_VERSION_1_3);
    std::size_t devices = 0;
    try {
        const vk::raii::Instance instance(context, vk::InstanceCreateInfo({}, &application));
        for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance)) {
            report.add(describe_device(device, devices++));
        }
    } catch (const vk::SystemError&) {
        // No driver at all: what follows says so, with the remedy.
        report.step("looking for Vulkan drivers");
    }
    report.step("opening the Vulkan device that the loop takes",
                devices == 0           ? vulkan::no_driver_remedy()
                : asked.device.empty() ? std::string()
                                       : "let vulkan.device be part of the name of one of the "
                                         "devices above that has all that is needed, or leave it "
                                         "out");
    const vulkan::Context chosen(
        {.validation = false, .device = asked.device, .device_origin = asked.device_origin},
        nullptr);
    report.add(describe_choice(chosen));
    report.step("reading the GPU's clock");
    report.add(check_gpu_clock(chosen));
}

}  // namespace

Findings check_vulkan(const VulkanChecks& asked, const ProbeLimits& limits) {
    ProbeResult result =
        run_probe([&](ProbeReport& report) { probe_vulkan(asked, report); }, limits);
    return std::move(result).findings_and_end("vulkan.choice", kDriverRemedy, /*stops_loop=*/true);
}

}  // namespace gazeloop::doctor

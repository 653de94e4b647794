#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "drivers/openxr/openxr_source.h"
#include "runtime/doctor/checks.h"
#include "runtime/doctor/eye_gaze_findings.h"
#include "runtime/doctor/probe.h"
#include "runtime/openxr/required_extensions.h"
#include "runtime/openxr/runtime_choice.h"
#include "runtime/openxr/start_errors.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/time/clock.h"

namespace gazeloop::doctor {
namespace {

using openxr::typed;
using openxr::xr_check;

constexpr const char* kOtherRuntime =
    "use another runtime (XR_RUNTIME_JSON), the Monado that ./dev setup builds, or --target "
    "headless";

constexpr const char* kVulkanFirst =
    "mend Vulkan first (above): runtimes render with it, too, and none starts without";

std::string remedy(const OpenXrChecks& asked, std::string_view first = "") {
    return asked.vulkan_works ? fmt::format("{}{}", first, kOtherRuntime) : kVulkanFirst;
}

/// What the runtime's manifest says of its library.
std::string library_of(const std::string& manifest) {
    std::ifstream file(manifest);
    const nlohmann::json parsed = nlohmann::json::parse(file, nullptr, false);
    const nlohmann::json runtime =
        parsed.is_object() ? parsed.value("runtime", nlohmann::json()) : nlohmann::json();
    return runtime.is_object() && runtime.contains("library_path") &&
                   runtime["library_path"].is_string()
               ? runtime["library_path"].get<std::string>()
               : "unknown";
}

/// The instance-level questions. A handle that is not released here goes with the process.
class RuntimeProbe {
  public:
    RuntimeProbe(const OpenXrChecks& asked, ProbeReport& report) : asked_(asked), report_(report) {}

    void run() {
        report_.step("choosing an OpenXR runtime");
        const openxr::RuntimeChoice choice = openxr::choose_runtime(asked_.display);
        const std::string library = library_of(choice.manifest);
        report_.add(
            {.check = "openxr.runtime",
             .found = fmt::format("{} ({}), library {}", choice.manifest, choice.reason, library),
             .facts = {
                 {"manifest", choice.manifest}, {"reason", choice.reason}, {"library", library}}});
        report_.step("loading the OpenXR runtime");
        list_extensions(choice);
        report_.step("creating an OpenXR instance",
                     remedy(asked_,
                            "start the runtime's service, if it is one with a service (Monado: "
                            "monado-service); or "));
        create_instance(choice);
        report_.step("asking for the headset",
                     remedy(asked_, "connect the headset and switch it on; or "));
        describe_system();
        report_.step("asking for eye gaze");
        check_eye_gaze();
        report_.step("converting OpenXR's time");
        check_time();
    }

  private:
    [[nodiscard]] bool offers(std::string_view name) const {
        return std::ranges::find(extensions_, name) != extensions_.end();
    }

    void list_extensions(const openxr::RuntimeChoice& choice) {
        std::uint32_t count = 0;
        if (const XrResult listed =
                xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
            XR_FAILED(listed)) {
            throw openxr::not_loaded(choice, listed);
        }
        std::vector<XrExtensionProperties> offered(
            count, typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES));
        xr_check(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, offered.data()),
                 "xrEnumerateInstanceExtensionProperties");
        for (const XrExtensionProperties& one : offered) {
            extensions_.emplace_back(one.extensionName);
        }
        std::vector<std::string> missing;
        for (const char* name : openxr::kRequiredXrExtensions) {
            if (!offers(name)) {
                missing.emplace_back(name);
            }
        }
        report_.add({.check = "openxr.extensions",
                     .verdict = missing.empty() ? Verdict::Ok : Verdict::Failure,
                     .found = missing.empty()
                                  ? fmt::format("{} offered, among them {}", extensions_.size(),
                                                fmt::join(openxr::kRequiredXrExtensions, ", "))
                                  : fmt::format("the runtime lacks {}", fmt::join(missing, ", ")),
                     .remedy = missing.empty() ? "" : kOtherRuntime,
                     .facts = {{"offered", extensions_}, {"missing", missing}},
                     .stops_loop = !missing.empty() && asked_.is_target});
    }

    void create_instance(const openxr::RuntimeChoice& choice) {
        std::vector<const char*> enabled;
        for (const char* name : openxr::kRequiredXrExtensions) {
            if (offers(name)) {
                enabled.push_back(name);
            }
        }
        if (offers(drivers::kEyeGazeExtension)) {
            enabled.push_back(drivers::kEyeGazeExtension);
        }
        auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
        std::strcpy(info.applicationInfo.applicationName, "gazeloop doctor");
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
        info.enabledExtensionNames = enabled.data();
        if (const XrResult created = xrCreateInstance(&info, &instance_); XR_FAILED(created)) {
            throw openxr::not_started(choice, created, nullptr);
        }
        auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
        xr_check(xrGetInstanceProperties(instance_, &properties), "xrGetInstanceProperties");
        const std::string version =
            fmt::format("{}.{}.{}", XR_VERSION_MAJOR(properties.runtimeVersion),
                        XR_VERSION_MINOR(properties.runtimeVersion),
                        XR_VERSION_PATCH(properties.runtimeVersion));
        report_.add({.check = "openxr.instance",
                     .found = fmt::format("{} {}", properties.runtimeName, version),
                     .facts = {{"name", properties.runtimeName}, {"version", version}}});
    }

    void describe_system() {
        auto get = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
        get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
        xr_check(xrGetSystem(instance_, &get, &system_),
                 "there is no head-mounted display now; connect one and switch it on");
        auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
        xr_check(xrGetSystemProperties(instance_, system_, &properties), "xrGetSystemProperties");
        constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
        std::array<XrViewConfigurationView, 2> views{
            typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW),
            typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW)};
        std::uint32_t count = 0;
        xr_check(xrEnumerateViewConfigurationViews(instance_, system_, kStereo, views.size(),
                                                   &count, views.data()),
                 "it has no two views for stereo");
        const XrViewConfigurationView& view = views[0];
        report_.add({.check = "openxr.system",
                     .found = fmt::format(
                         "{}: {} views, {}x{} recommended, {}x{} at most", properties.systemName,
                         count, view.recommendedImageRectWidth, view.recommendedImageRectHeight,
                         view.maxImageRectWidth, view.maxImageRectHeight),
                     .facts = {{"name", properties.systemName},
                               {"views", count},
                               {"recommended_width_px", view.recommendedImageRectWidth},
                               {"recommended_height_px", view.recommendedImageRectHeight}}});
    }

    /// As far as gates can be seen without a session.
    void check_eye_gaze() {
        drivers::GazeGates gates;
        if (drivers::check_instance_gates(instance_, system_, offers(drivers::kEyeGazeExtension),
                                          gates)) {
            const XrResult suggested = drivers::EyeGazeAction(instance_).suggested();
            gates.set(drivers::GazeGate::Binding,
                      {XR_SUCCEEDED(suggested), openxr::xr_name(suggested)}, time::monotonic_ns());
        }
        for (const Finding& finding : eye_gaze_findings(gates)) {
            report_.add(finding);
        }
    }

    /// There and back again: what a stamp loses on its way through the runtime's clock.
    void check_time() {
        if (!offers(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME)) {
            return;  // already a failure
        }
        const auto to_xr = openxr::xr_function<PFN_xrConvertTimespecTimeToTimeKHR>(
            instance_, "xrConvertTimespecTimeToTimeKHR");
        const auto from_xr = openxr::xr_function<PFN_xrConvertTimeToTimespecTimeKHR>(
            instance_, "xrConvertTimeToTimespecTimeKHR");
        constexpr int kTrips = 100;
        constexpr std::int64_t kLargestErrorNs = 1000;
        std::int64_t worst_ns = 0;
        for (int i = 0; i < kTrips; ++i) {
            const std::int64_t now_ns = time::monotonic_ns();
            const timespec now{now_ns / 1'000'000'000, now_ns % 1'000'000'000};
            XrTime there = 0;
            timespec back{};
            xr_check(to_xr(instance_, &now, &there), "xrConvertTimespecTimeToTimeKHR");
            xr_check(from_xr(instance_, there, &back), "xrConvertTimeToTimespecTimeKHR");
            const std::int64_t back_ns = std::int64_t{back.tv_sec} * 1'000'000'000 + back.tv_nsec;
            worst_ns = std::max(worst_ns, std::abs(back_ns - now_ns));
        }
        const bool good = worst_ns <= kLargestErrorNs;
        report_.add({.check = "openxr.clock",
                     .verdict = good ? Verdict::Ok : Verdict::Warning,
                     .found = fmt::format(
                         "CLOCK_MONOTONIC to XrTime and back: off by at most {} ns", worst_ns),
                     .remedy = good ? ""
                                    : "report it to the runtime's authors: its display times "
                                      "cannot be trusted to be better than this",
                     .facts = {{"worst_error_ns", worst_ns}}});
    }

    const OpenXrChecks& asked_;
    ProbeReport& report_;
    std::vector<std::string> extensions_;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
};

/// What the loop itself does before its first frame.
void probe_session(const OpenXrChecks& asked, ProbeReport& report) {
    std::optional<vulkan::Context> opened;  // outlives the target
    report.step("setting up the loop's OpenXR target");
    const auto target = present::make_openxr_target(
        {.display = asked.display, .scale = asked.scale, .validation = asked.validation});
    report.step("opening the Vulkan device that the OpenXR runtime wants");
    const vulkan::Context& context =
        opened.emplace(vulkan::ContextOptions{}, target->vulkan_factory());
    report.step("starting the OpenXR session");
    target->start(context);
    const bool software =
        context.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    const vk::Extent2D extent = target->extents()[0];
    report.add({.check = "openxr.session",
                .verdict = software ? Verdict::Warning : Verdict::Ok,
                .found = fmt::format("{}x{} per eye as {}, on {}{}", extent.width, extent.height,
                                     vk::to_string(target->format()), context.device_name(),
                                     software ? ": rendered on the processor, not real time" : ""),
                .remedy = software ? "use a machine with a GPU, or a small picture (--set "
                                     "render.scale=0.15)"
                                   : "",
                .facts = {{"width_px", extent.width},
                          {"height_px", extent.height},
                          {"format", vk::to_string(target->format())},
                          {"device", context.device_name()}}});
}

}  // namespace

Findings check_openxr(const OpenXrChecks& asked, const ProbeLimits& limits) {
    ProbeResult runtime =
        run_probe([&](ProbeReport& report) { RuntimeProbe(asked, report).run(); }, limits);
    const bool runtime_works = runtime.broken.empty();
    Findings findings =
        std::move(runtime).findings_and_end("openxr.start", remedy(asked), asked.is_target);
    if (runtime_works) {
        ProbeResult session =
            run_probe([&](ProbeReport& report) { probe_session(asked, report); }, limits);
        std::ranges::move(
            std::move(session).findings_and_end("openxr.session", remedy(asked), asked.is_target),
            std::back_inserter(findings));
    }
    return findings;
}

}  // namespace gazeloop::doctor

#include "runtime/vulkan/driver_environment.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/environment.h"
#include "runtime/vulkan/loader_manifest.h"

namespace gazeloop::vulkan {
namespace {

/// Of the variables that list drivers the first one that is set counts (LoaderInterfaceArchitecture
/// of Vulkan-Loader).
constexpr std::array kDriverLists{"VK_DRIVER_FILES", "VK_ICD_FILENAMES"};
constexpr std::array kDriverFilters{"VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"};

std::vector<std::string> faults_of(const char* variable, const std::string& list) {
    std::vector<std::string> faults;
    for (const std::string& file : split_list(list)) {
        // A folder may stand for the manifests in it.
        if (std::error_code ignored; std::filesystem::is_directory(file, ignored)) {
            continue;
        }
        if (const auto fault = manifest_fault(file, "ICD")) {
            faults.push_back(fmt::format("{} names '{}', which {}", variable, file, *fault));
        }
    }
    return faults;
}

}  // namespace

std::string driver_environment_fault() {
    std::vector<std::string> faults;
    std::vector<std::string> variables;
    for (const char* variable : kDriverLists) {
        if (const auto list = environment_value(variable)) {
            faults = faults_of(variable, *list);
            if (!faults.empty()) {
                variables.emplace_back(variable);
            }
            break;
        }
    }
    for (const char* variable : kDriverFilters) {
        if (const auto filter = environment_value(variable)) {
            faults.push_back(fmt::format("{}='{}' leaves drivers out", variable, *filter));
            variables.emplace_back(variable);
        }
    }
    return faults.empty() ? std::string()
                          : fmt::format("{}: correct or unset {}", fmt::join(faults, "; "),
                                        fmt::join(variables, " and "));
}

std::string no_driver_remedy() {
    std::string fault = driver_environment_fault();
    return !fault.empty() ? fault
                          : "install a Vulkan 1.3 driver (on Debian without a GPU: apt-get install "
                            "mesa-vulkan-drivers) and check it with vulkaninfo";
}

}  // namespace gazeloop::vulkan

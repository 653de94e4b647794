#include "runtime/trade/processor_energy.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

namespace gazeloop::trade {
namespace {

namespace fs = std::filesystem;

/// A file's first word; empty where it cannot be read.
std::string word_of(const fs::path& file) {
    std::ifstream in(file);
    std::string word;
    in >> word;
    return word;
}

/// None: `errno` says why the file cannot be read; 0: it holds no number.
std::optional<std::uint64_t> number_of(const fs::path& file) {
    errno = 0;
    std::ifstream in(file);
    std::uint64_t number = 0;
    if (in >> number) {
        return number;
    }
    return std::nullopt;
}

/// The zones of whole packages, by their names: "package-0", "package-1-die-0". Some processors
/// tell of one package twice, as a register's and as a memory-mapped zone ("intel-rapl-mmio:0"):
/// the former counts.
std::map<std::string, fs::path> packages_of(const fs::path& powercap) {
    std::map<std::string, fs::path> packages;
    std::error_code error;
    for (const fs::directory_entry& zone : fs::directory_iterator(powercap, error)) {
        const std::string name = word_of(zone.path() / "name");
        if (!name.starts_with("package-")) {
            continue;
        }
        fs::path& known = packages[name];
        if (known.empty() || known.filename().string().find("-mmio") != std::string::npos) {
            known = zone.path();
        }
    }
    return packages;
}

}  // namespace

ProcessorEnergy::ProcessorEnergy(const fs::path& powercap) {
    for (const auto& [name, zone] : packages_of(powercap)) {
        Package package{.counter = zone / "energy_uj"};
        const auto now = number_of(package.counter);
        if (!now) {
            unavailable_ = fmt::format(
                "{}: {}", package.counter.string(),
                errno == EACCES ? "may be read by root alone: run as root, or let others read it"
                : errno == 0    ? "holds no number"
                                : std::generic_category().message(errno));
            packages_.clear();
            return;
        }
        package.last_uj = *now;
        package.range_uj = number_of(zone / "max_energy_range_uj").value_or(0);
        packages_.push_back(std::move(package));
    }
    if (packages_.empty()) {
        unavailable_ = fmt::format(
            "{} has no counters of the processor's packages: a virtual machine, or a kernel or "
            "processor without them",
            powercap.string());
    }
}

std::optional<double> ProcessorEnergy::joules() {
    if (packages_.empty()) {
        return std::nullopt;
    }
    for (Package& package : packages_) {
        const auto now = number_of(package.counter);
        // A counter that fell without a range to wrap at was set back: what it took is unknown.
        if (!now || (*now < package.last_uj && package.range_uj < package.last_uj)) {
            package.last_uj = now.value_or(package.last_uj);
            return std::nullopt;
        }
        taken_uj_ += *now >= package.last_uj ? *now - package.last_uj
                                             : package.range_uj - package.last_uj + *now;
        package.last_uj = *now;
    }
    return 1e-6 * static_cast<double>(taken_uj_);
}

}  // namespace gazeloop::trade

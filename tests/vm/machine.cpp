#include "tests/vm/machine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "tests/support/background_process.h"
#include "tests/support/cache_folder.h"

namespace gazeloop::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEmulator = "/usr/bin/qemu-system-x86_64";
constexpr int kMemory_mib = 1536;

fs::path machine_file(const std::string& name) {
    return fs::path(GAZELOOP_BINARY_DIR) / "vm" / name;
}
fs::path kernel_folder() { return fs::path(cache_folder()) / "vm-kernel"; }

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::uintmax_t bytes_of(const fs::path& file) {
    std::error_code none;
    const std::uintmax_t bytes = fs::file_size(file, none);
    return none ? 0 : bytes;
}

double free_memory_mib() {
    std::istringstream lines(text_of("/proc/meminfo"));
    std::string name;
    double kib = 0.0;
    std::string unit;
    while (lines >> name >> kib) {
        std::getline(lines, unit);
        if (name == "MemAvailable:") {
            return kib / 1024.0;
        }
    }
    return 0.0;
}

/// Waits for its end for as long as something happens in it. The exit code; -1: it hung.
int wait_while_it_works(BackgroundProcess& emulator) {
    constexpr std::chrono::minutes kSilence{3};
    std::uintmax_t said = 0;
    auto last = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - last < kSilence) {
        if (const int code = emulator.wait(std::chrono::seconds(1)); code >= 0) {
            return code;
        }
        const std::uintmax_t now =
            bytes_of(machine_file("kernel.log")) + bytes_of(machine_file("results.log"));
        if (now != said) {
            said = now;
            last = std::chrono::steady_clock::now();
        }
    }
    return -1;
}

}  // namespace

std::string missing_for_machine() {
    constexpr const char* kRemedy = "./dev test --vm installs it";
#ifndef __x86_64__
    return "the virtual machine runs x86-64 programs only";
#endif
    for (const char* program : {kEmulator, "/bin/busybox", "/bin/udevadm"}) {
        if (access(program, X_OK) != 0) {
            return fmt::format("there is no {}: {}", program, kRemedy);
        }
    }
    for (const char* file : {"vmlinuz", "modules/order"}) {
        if (!fs::exists(kernel_folder() / file)) {
            return fmt::format("there is no Linux kernel at {}: {}", kernel_folder().string(),
                               kRemedy);
        }
    }
    if (const double free_mib = free_memory_mib(); free_mib < 1.5 * kMemory_mib) {
        return fmt::format("{:.0f} MiB of memory are free, {:.0f} are needed", free_mib,
                           1.5 * kMemory_mib);
    }
    return "";
}

std::string run_machine() {
    const std::string build = GAZELOOP_BINARY_DIR;
    const std::string source = GAZELOOP_SOURCE_DIR;
    const std::string archive = machine_file("guest.cpio");
    BackgroundProcess packing(
        {.command = {source + "/tests/vm/make_guest.sh", archive, kernel_folder(),
                     source + "/config/udev/70-gazeloop.rules", build + "/gazeloop",
                     build + "/tests/vm/vm_gadget", build + "/tests/vm/vm_kernel_parser"},
         .environment = {},
         .output_file = machine_file("packing.log")});
    if (packing.wait(std::chrono::minutes(2)) != 0) {
        return "its file system could not be made: " + packing.output();
    }
    // TCG also where there is KVM: a machine inside a machine may have one that does not work.
    BackgroundProcess emulator(
        {.command = {kEmulator,
                     "-accel",
                     "tcg,thread=multi",
                     "-machine",
                     "pc",
                     "-smp",
                     "2",
                     "-m",
                     std::to_string(kMemory_mib),
                     "-nodefaults",
                     "-no-user-config",
                     "-display",
                     "none",
                     "-no-reboot",
                     "-kernel",
                     kernel_folder() / "vmlinuz",
                     "-initrd",
                     archive,
                     "-append",
                     "console=ttyS0 loglevel=6 panic=-1 rdinit=/init",
                     "-serial",
                     "file:" + machine_file("kernel.log").string(),
                     "-device",
                     "virtio-serial-pci",
                     "-chardev",
                     "file,id=results,path=" + machine_file("results.log").string(),
                     "-device",
                     "virtserialport,chardev=results"},
         .environment = {},
         .output_file = machine_file("emulator.log")});
    const int code = wait_while_it_works(emulator);
    fs::remove(archive);
    if (code != 0) {
        return fmt::format("QEMU {}: {}", code < 0 ? "shows no progress" : "failed",
                           emulator.output());
    }
    if (text_of(machine_file("results.log")).find("@@done") == std::string::npos) {
        return "it did not get to its end; see " + machine_file("kernel.log").string();
    }
    return "";
}

std::map<std::string, Section> machine_sections() {
    std::map<std::string, Section> sections;
    std::istringstream lines(text_of(machine_file("results.log")));
    std::string name;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string mark;
        words >> mark;
        if (mark == "@@begin") {
            words >> name;
            sections[name] = {};
        } else if (mark == "@@end") {
            words >> name >> sections[name].exit_code;
            name.clear();
        } else if (mark == "@@done") {
            return sections;
        } else if (!name.empty()) {
            sections[name].text += line + "\n";
        }
    }
    throw std::runtime_error("the virtual machine has not run to its end");
}

std::string machine_skipped() { return text_of(machine_file("skipped")); }

void skip_machine(const std::string& reason) {
    fs::remove_all(machine_file(""));
    fs::create_directories(machine_file(""));
    std::ofstream(machine_file("skipped")) << reason;
}

}  // namespace gazeloop::tests

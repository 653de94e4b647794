#include "runtime/openxr_layer/layer_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <new>
#include <set>
#include <string>

#include "runtime/openxr_layer/private_file.h"
#include "runtime/openxr_layer/user_folders.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::size_t kMostLogBytes = 1'000'000;
/// A program for days says more than this only if something is very wrong.
constexpr std::size_t kMostLines = 1'000;

struct Said {
    std::mutex mutex;
    std::set<std::string, std::less<>> texts;
};

/// Never destroyed: while a program ends, threads of it or of the layer's may still have something
/// to say.
Said& said() {
    alignas(Said) static std::array<std::byte, sizeof(Said)> memory;
    static Said& the_said = *new (memory.data()) Said;
    return the_said;
}

void write_line(LogLevel level, std::string_view text) {
    const std::string_view name = level == LogLevel::Warning ? "warning" : "info";
    if (level == LogLevel::Warning) {
        const std::string line = fmt::format("gazeloop layer: {}: {}\n", name, text);
        [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    }
    if (const auto folder = layer_state()) {
        const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
        append_private(*folder / "layer.log",
                       fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {} {}: {}\n", fmt::gmtime(now),
                                   ::getpid(), name, text),
                       kMostLogBytes);
    }
}

}  // namespace

void say(LogLevel level, std::string_view text) noexcept {
    try {
        Said& before = said();
        const std::lock_guard lock(before.mutex);
        if (before.texts.size() < kMostLines && before.texts.emplace(text).second) {
            write_line(level, text);
        }
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // A line less, in a program that has other things to do.
    }
}

void note(LogLevel level, std::string_view text) noexcept {
    try {
        const std::lock_guard lock(said().mutex);
        write_line(level, text);
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // As above.
    }
}

void forget_said() noexcept {
    Said& before = said();
    const std::lock_guard lock(before.mutex);
    before.texts.clear();
}

}  // namespace gazeloop::openxr_layer

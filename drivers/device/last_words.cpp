#include "drivers/device/last_words.h"

#include <unistd.h>

#include <atomic>
#include <string>

namespace gazeloop::drivers {
namespace {

void onto_stderr(std::string_view line) noexcept {
    try {
        const std::string text = "gazeloop: " + std::string(line) + "\n";
        [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // Out of memory: a line less.
    }
}

std::atomic<LastWords> last_words{&onto_stderr};

}  // namespace

void set_last_words(LastWords say) noexcept { last_words = say != nullptr ? say : &onto_stderr; }

void say_last_words(std::string_view line) noexcept { last_words.load()(line); }

}  // namespace gazeloop::drivers

#include "runtime/files/unfinished_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace gazeloop::files {
namespace {

enum class State : std::uint8_t { Free, Taken, Named };

struct Slot {
    std::atomic<State> state = State::Free;
    std::array<char, UnfinishedFile::kLongestName> name{};
};

static_assert(std::atomic<State>::is_always_lock_free, "a signal's handler reads it");

std::array<Slot, UnfinishedFile::kMost> slots;

}  // namespace

UnfinishedFile::UnfinishedFile(const std::string& file) {
    if (file.size() >= kLongestName) {
        return;
    }
    for (std::size_t i = 0; i < kMost; ++i) {
        State free = State::Free;
        if (slots[i].state.compare_exchange_strong(free, State::Taken)) {
            *std::ranges::copy(file, slots[i].name.begin()).out = '\0';
            slots[i].state = State::Named;
            slot_ = i;
            return;
        }
    }
}

UnfinishedFile::~UnfinishedFile() {
    if (slot_ < kMost) {
        slots[slot_].state = State::Free;
    }
}

void remove_unfinished_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == State::Named) {
            ::unlink(slot.name.data());
        }
    }
}

}  // namespace gazeloop::files

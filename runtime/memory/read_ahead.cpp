#include "runtime/memory/read_ahead.h"

#include <algorithm>

#include "runtime/signals_blocked.h"

namespace gazeloop::memory {

ReadAhead::ReadAhead(const ScratchFile& file, std::uint32_t places) : file_(file), places_(places) {
    const SignalsBlocked blocked;
    thread_ = std::thread([this] { run(); });
}

ReadAhead::~ReadAhead() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    asked_.notify_one();
    thread_.join();
}

void ReadAhead::ask(std::uint32_t place, std::size_t at, std::span<std::byte> into) {
    {
        const std::lock_guard lock(mutex_);
        places_[place] = {State::Asked, at, into};
        order_.push_back(place);
    }
    asked_.notify_one();
}

ReadAhead::State ReadAhead::state(std::uint32_t place) const {
    const std::lock_guard lock(mutex_);
    return places_[place].state;
}

bool ReadAhead::take_back(std::uint32_t place) {
    const std::lock_guard lock(mutex_);
    if (places_[place].state != State::Asked) {
        return false;
    }
    places_[place] = {};
    std::erase(order_, place);
    return true;
}

bool ReadAhead::take(std::uint32_t place) {
    std::unique_lock lock(mutex_);
    Place& taken = places_[place];
    done_.wait(lock, [&] { return taken.state == State::Read || taken.state == State::Failed; });
    const bool read = taken.state == State::Read;
    taken = {};
    return read;
}

void ReadAhead::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        asked_.wait(lock, [this] { return ending_ || !order_.empty(); });
        if (ending_) {
            return;
        }
        Place& next = places_[order_.front()];
        order_.pop_front();
        next.state = State::UnderWay;
        const std::size_t at = next.at;
        const std::span<std::byte> into = next.into;
        lock.unlock();
        const bool read = file_.read(at, into).has_value();
        lock.lock();
        next.state = read ? State::Read : State::Failed;
        done_.notify_one();
    }
}

}  // namespace gazeloop::memory

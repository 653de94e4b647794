#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "runtime/memory/scratch_file.h"

namespace gazeloop::memory {

/// Reads parts of a scratch file on a thread of its own, one after the other as they were asked
/// for, into memory of whoever asks: each into a place that has a number, and that holds one part
/// at a time. All is asked by one other thread.
class ReadAhead {
  public:
    enum class State : std::uint8_t {
        Free,      ///< nothing was asked for, or it was taken
        Asked,     ///< not begun yet
        UnderWay,  ///< the place's memory is the thread's
        Read,
        Failed,  ///< what is in the place's memory means nothing
    };

    /// The file must outlive this. Throws std::system_error where the system has no thread left.
    ReadAhead(const ScratchFile& file, std::uint32_t places);
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;
    /// Ends after the part that is under way; the others are not read any more.
    ~ReadAhead();

    /// Preconditions: the place is free; so much was written to the file there. The memory must
    /// stay until the place is free again.
    void ask(std::uint32_t place, std::size_t at, std::span<std::byte> into);
    [[nodiscard]] State state(std::uint32_t place) const;
    /// Frees a place whose part is not begun; else false.
    bool take_back(std::uint32_t place);
    /// Waits for a part that was asked for, and frees its place; whether it was read.
    [[nodiscard]] bool take(std::uint32_t place);

  private:
    struct Place {
        State state = State::Free;
        std::size_t at = 0;
        std::span<std::byte> into;
    };
    void run();

    const ScratchFile& file_;
    mutable std::mutex mutex_;
    std::condition_variable asked_;
    std::condition_variable done_;
    std::vector<Place> places_;
    std::deque<std::uint32_t> order_;  ///< places that were asked for, the first one next
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace gazeloop::memory

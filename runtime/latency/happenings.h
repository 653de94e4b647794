#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/fixed_text.h"
#include "runtime/frame/event.h"
#include "runtime/time/stamp.h"

namespace gazeloop::latency {

/// Something that happened once or often: events of one kind whose texts differ in numbers alone.
struct Happening {
    FixedText<32> kind;
    FixedText<240> text;  ///< the last one's
    frame::EventWeight weight = frame::EventWeight::Notice;
    std::uint64_t times = 0;
    time::Stamp first;  ///< of those whose time is known; unknown where none is
    time::Stamp last;
};

/// Gathers what a user should know of a run (frame::EventWeight::Notice and more), in fixed memory.
class Happenings {
  public:
    static constexpr std::size_t kMost = 32;
    /// The place of whatever is more than the others.
    static constexpr std::size_t kOthers = kMost;

    /// The place of the event among list(); kOthers where that is full. Precondition: the kind is
    /// no routine.
    std::size_t add(const time::Stamp& time, std::string_view kind, std::string_view text);

    /// In the order of their first event.
    [[nodiscard]] std::span<const Happening> list() const { return {all_.data(), size_}; }
    /// Events that are in none of the list, which was full.
    [[nodiscard]] std::uint64_t others() const { return others_; }

  private:
    std::array<Happening, kMost> all_;
    std::size_t size_ = 0;
    std::uint64_t others_ = 0;
};

/// Whether two texts are the same but for the numbers in them ("went back by 3.1 ms").
[[nodiscard]] bool same_but_for_numbers(std::string_view a, std::string_view b);

}  // namespace gazeloop::latency

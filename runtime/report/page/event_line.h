#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/frame/event.h"
#include "runtime/frame/frame_observer.h"

namespace gazeloop::report::page {

/// The events of a session by their times, for its time line. Keeps the time of each one (8 bytes)
/// and the texts of the first of each kind.
class EventLine final : public frame::FrameObserver {
  public:
    /// Texts that are kept of each kind, and kinds that are kept apart: what a recording's kinds
    /// are, its file decides.
    static constexpr std::size_t kMostTexts = 100;
    static constexpr std::size_t kMostKinds = 64;
    static constexpr std::size_t kLongestText = 500;  ///< bytes; more is cut, and says so

    struct Text {
        std::optional<std::int64_t> ns;  ///< host time; none: unknown
        std::string text;
    };
    struct Kind {
        std::string name;
        frame::EventWeight weight = frame::EventWeight::Notice;
        std::uint64_t times = 0;         ///< all of them
        std::vector<std::int64_t> ns{};  ///< host times of those with a known one, in their order
        std::vector<Text> texts{};       ///< the first kMostTexts
    };

    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;

    /// In the order of their first event.
    [[nodiscard]] const std::vector<Kind>& kinds() const { return kinds_; }
    /// Events of further kinds.
    [[nodiscard]] std::uint64_t others() const { return others_; }

  private:
    std::vector<Kind> kinds_;
    std::uint64_t others_ = 0;
};

}  // namespace gazeloop::report::page

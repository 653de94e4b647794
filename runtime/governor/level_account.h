#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/frame/frame_observer.h"
#include "runtime/governor/front.h"

namespace gazeloop::governor {

/// Gathers by which levels of a front a run's frames were drawn, and how many kept the display's
/// period, from frames: a run's own or a session's.
class LevelAccount final : public frame::FrameObserver {
  public:
    explicit LevelAccount(Front front) : front_(std::move(front)) {}

    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

    /// One line for people: "the governor held level 2 of 6: ..."; says so where it drew nothing.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::ordered_json json() const;

  private:
    struct OfLevel {
        std::uint64_t frames = 0;
        std::uint64_t timed = 0;   ///< of them, how long they took is known
        std::uint64_t within = 0;  ///< of these, took no longer than the period
    };
    struct UnderWay {
        std::uint64_t frame = 0;
        std::size_t level = kMostLevels;
        std::int64_t period_ns = 0;
    };
    [[nodiscard]] OfLevel all() const;

    static constexpr std::size_t kUnderWay = 16;  ///< more than frames can be on the GPU

    Front front_;
    std::array<OfLevel, kMostLevels> levels_{};
    std::array<UnderWay, kUnderWay> under_way_{};
    std::optional<std::size_t> last_;
    std::uint64_t changes_ = 0;
};

}  // namespace gazeloop::governor

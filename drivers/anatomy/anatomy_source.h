#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/gaze/anatomy.h"

namespace gazeloop::drivers {

/// Another source, whose first samples are held against anatomy (gaze/anatomy.h) while it plays:
/// what was found is told once, as an event of the kind "axes" where directions are in doubt, else
/// as one of the tracker's. Samples pass unchanged.
class AnatomySource final : public GazeSource {
  public:
    /// So many samples with both eyes decide; or thrice as many with any.
    static constexpr std::size_t kDecide = 300;

    explicit AnatomySource(std::unique_ptr<GazeSource> source);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    void take_seen_depth(const gaze::SeenDepth& seen) override { source_->take_seen_depth(seen); }
    [[nodiscard]] std::vector<SourceEvent> take_events() override;
    [[nodiscard]] const gaze::HeadMotion* head_track() const override {
        return source_->head_track();
    }
    [[nodiscard]] bool fixed_in_head() const override { return source_->fixed_in_head(); }
    [[nodiscard]] const gaze::GazeTrace* trace() const override { return source_->trace(); }
    [[nodiscard]] bool finished() const override { return source_->finished(); }
    [[nodiscard]] std::string description() const override { return source_->description(); }

  private:
    std::unique_ptr<GazeSource> source_;
    std::optional<gaze::AnatomyCheck> check_;  ///< until it is decided
    std::optional<SourceEvent> found_;         ///< not taken yet
};

}  // namespace gazeloop::drivers

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/frame/frame_gaze.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/latency/sample_counter.h"
#include "runtime/report/perfetto/drawing.h"

namespace gazeloop::report::perfetto {

/// Draws what happens at one time: events, samples, and what is lacking.
class EventDrawing {
  public:
    EventDrawing(TraceWriter& writer, Drawing& drawing);

    void add(const time::Stamp& time, std::string_view kind, std::string_view text);
    /// In the order of arrival. What was lost or out of order is drawn always, the sample itself if
    /// `each`.
    void add(const gaze::GazeSample& sample, bool each);
    /// What had become of all samples up to a frame, which read the gaze at `at`: for who is not
    /// told of each.
    void add(const frame::GazeCounts& counts, const time::Stamp& at);
    /// A frame, in the order of their indices; woken up at `at`.
    void add_frame(std::uint64_t index, const time::Stamp& at);

    [[nodiscard]] std::uint64_t samples() const {
        return std::max(counter_.counts().received, told_.received);
    }

  private:
    void add_count(Subject subject, NameId name, std::uint64_t count, const time::Stamp& at);

    Drawing& drawing_;
    NameId sample_;
    NameId invalid_;
    NameId lost_;
    NameId out_of_order_;
    NameId frames_lacking_;
    KeyId text_;
    KeyId sequence_;
    KeyId count_;
    latency::SampleCounter counter_;
    frame::GazeCounts told_;  ///< instead of each sample
    std::optional<std::uint64_t> last_frame_;
};

}  // namespace gazeloop::report::perfetto

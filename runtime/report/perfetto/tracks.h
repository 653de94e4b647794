#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/report/perfetto/subject.h"
#include "runtime/report/perfetto/trace_writer.h"

namespace gazeloop::report::perfetto {

/// The tracks of a session: one for each subject, and more where its slices overlap, since slices
/// of one track must nest. A track is described when something is on it for the first time.
class Tracks {
  public:
    static constexpr std::size_t kMostLanes = 16;

    /// `about`: what the trace says of itself.
    Tracks(TraceWriter& writer, const std::string& about);

    /// The subject's track for what cannot overlap.
    TrackId of(Subject subject);

    /// The subject's first track that is free from `from_ns` on; it then is taken until `to_ns`.
    /// None: all are taken. Precondition: from_ns <= to_ns.
    std::optional<TrackId> take(Subject subject, std::int64_t from_ns, std::int64_t to_ns);

  private:
    struct Lane {
        TrackId id = 0;
        std::int64_t free_from_ns = std::numeric_limits<std::int64_t>::min();
    };
    struct Lanes {
        std::array<Lane, kMostLanes> all;
        std::size_t count = 0;
    };

    Lane& add_lane(Subject subject);

    TraceWriter& writer_;
    TrackId last_id_ = 0;
    TrackId root_ = 0;
    std::array<Lanes, kSubjects> lanes_;
};

}  // namespace gazeloop::report::perfetto

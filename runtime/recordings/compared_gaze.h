#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/eye.h"

namespace gazeloop::recordings {

/// Where one eye looks while pictures are compared: at one place, or along a recorded trace.
class ComparedGaze {
  public:
    /// "AZ,EL" in degrees, or "trace:FILE" (a trace or a session). Errors: Usage for what is
    /// neither; BadInput for a trace without a valid sample of this eye.
    /// @throws SetupError as recorded_gaze()
    static Expected<ComparedGaze> parse(const std::string& text, gaze::Eye eye);

    /// In the head frame, so long after the first sample: by the newest valid sample until then, or
    /// the first one.
    [[nodiscard]] glm::dvec3 direction_at(std::int64_t time_ns) const;
    /// When the trace's last sample was; none: it looks at one place for ever.
    [[nodiscard]] std::optional<std::int64_t> end_ns() const;
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    struct Looked {
        std::int64_t time_ns;
        glm::dvec3 direction;
    };
    std::string text_;
    bool moves_ = false;
    std::int64_t end_ns_ = 0;
    std::vector<Looked> looked_;  ///< in order of time; at least one
};

}  // namespace gazeloop::recordings

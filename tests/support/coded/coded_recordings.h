#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gazeloop::tests {

/// A sample and what two coders called it: 1 fixation, 2 saccade, 3 oscillation, 4 pursuit,
/// 5 blink, 6 undefined.
struct CodedSample {
    std::int64_t time_ns = 0;
    std::optional<glm::dvec3>
        direction;         ///< a unit vector, screen ahead; none: the tracker had none
    int first_coder = 0;   ///< MN
    int second_coder = 0;  ///< RA
};

struct CodedRecording {
    std::string person;
    std::string stimulus;  ///< "img", "dots" or "video"
    /// Every other person, in the order of their names: parameters are chosen on these alone.
    bool chosen_on = false;
    std::vector<CodedSample> samples;
};

inline constexpr int kCoders = 2;
inline constexpr const char* kStimuli[] = {"img", "dots", "video"};

/// The recordings of Andersson et al. 2017 that lie under `folder` (a CSV file each with its
/// geometry as JSON beside it), in the order of their names. Throws std::runtime_error where a file
/// is not as expected.
[[nodiscard]] std::vector<CodedRecording> read_coded_recordings(
    const std::filesystem::path& folder);

/// Where they are expected, beside the project; not part of it.
[[nodiscard]] std::filesystem::path coded_recordings_folder();

/// Every so many samples of a recording only, as a slower tracker would have them.
[[nodiscard]] CodedRecording thinned(const CodedRecording& recording, std::size_t every);

}  // namespace gazeloop::tests

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/gaze/eye.h"

namespace gazeloop::drivers::steam_frame {

// The file in which the Steam Frame's eye service publishes gaze, /dev/shm/eye-server.mmap. Its
// maker documents nothing; this is what three public tools that read it agree on. Little-endian and
// unaligned:
//
//   0x00  u32  version of the layout
//   0x04  u32  not 0: initialised
//   0x38  u32  counts the samples
//   then the record, where the version says:
//   0x05  f64  time, seconds of CLOCK_MONOTONIC_RAW
//   0x0d  directions, left then right, 3 f32 each, in the head (+X right, -Z forward): fused of
//   both
//         eyes and filtered; 0x25 their variances
//   0x3d  the point that both look at, 3 f32, metres
//   0x49  directions of each eye before fusion; 0x61 their variances
//   0x79  openness, left and right, f32
//
// What marks a lost eye is not known. A direction of zero or NaN is taken for one.

/// A version of the layout that is known.
struct Layout {
    std::uint32_t version;
    std::string_view build;  ///< of the headset's software that wrote it
    std::size_t record_at;   ///< byte
};
inline constexpr std::array<Layout, 2> kLayouts{Layout{4, "20260921", 0x152},
                                                Layout{5, "20260930", 0x157}};

inline constexpr std::size_t kRecordBytes = 0x81;
/// From the begin of the file, so that the record of every known version is in it.
inline constexpr std::size_t kImageBytes = 0x157 + kRecordBytes;
using Image = std::array<std::uint8_t, kImageBytes>;

struct Header {
    std::uint32_t version = 0;
    bool initialised = false;
    std::uint32_t counter = 0;
};
[[nodiscard]] Header decode_header(const Image& image);

/// The layout of a file that is ready to be read. Errors (NoDevice): of a version that is not
/// known, which is named and never guessed at, or not initialised yet.
[[nodiscard]] Expected<Layout> layout_of(const Header& header);

using RecordBytes = std::span<const std::uint8_t, kRecordBytes>;
/// The record in an image of a file of that layout.
[[nodiscard]] RecordBytes record_in(const Image& image, const Layout& layout);

/// As the bytes say; any number may be anything.
struct GazeRecord {
    struct Ray {
        glm::dvec3 direction{0.0};
        glm::dvec3 variances{0.0};  ///< of its components
    };
    double time_s = 0.0;
    gaze::PerEye<Ray> filtered;       ///< fused of both eyes, and filtered
    gaze::PerEye<Ray> before_fusion;  ///< of each eye by itself
    glm::dvec3 fixation_m{0.0};
    gaze::PerEye<double> openness{};
};
[[nodiscard]] GazeRecord decode_record(RecordBytes bytes);

}  // namespace gazeloop::drivers::steam_frame

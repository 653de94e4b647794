#include "drivers/steam_frame/gaze_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>

namespace gazeloop::drivers::steam_frame {
namespace {

constexpr std::size_t kVersionAt = 0x00;
constexpr std::size_t kInitialisedAt = 0x04;
constexpr std::size_t kCounterAt = 0x38;

constexpr std::size_t kTimeAt = 0x05;
constexpr std::size_t kFilteredAt = 0x0d;
constexpr std::size_t kFilteredVariancesAt = 0x25;
constexpr std::size_t kFixationAt = 0x3d;
constexpr std::size_t kBeforeFusionAt = 0x49;
constexpr std::size_t kBeforeFusionVariancesAt = 0x61;
constexpr std::size_t kOpennessAt = 0x79;
constexpr std::size_t kFloatBytes = 4;
constexpr std::size_t kVectorBytes = 3 * kFloatBytes;

template <typename Unsigned>
Unsigned little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    Unsigned value = 0;
    for (std::size_t i = sizeof(Unsigned); i-- > 0;) {
        value = static_cast<Unsigned>(value << 8U) | bytes[at + i];
    }
    return value;
}

double real(RecordBytes bytes, std::size_t at) {
    return static_cast<double>(std::bit_cast<float>(little_endian<std::uint32_t>(bytes, at)));
}

glm::dvec3 vector(RecordBytes bytes, std::size_t at) {
    return {real(bytes, at), real(bytes, at + kFloatBytes), real(bytes, at + 2 * kFloatBytes)};
}

gaze::PerEye<GazeRecord::Ray> rays(RecordBytes bytes, std::size_t directions,
                                   std::size_t variances) {
    return {GazeRecord::Ray{vector(bytes, directions), vector(bytes, variances)},
            GazeRecord::Ray{vector(bytes, directions + kVectorBytes),
                            vector(bytes, variances + kVectorBytes)}};
}

}  // namespace

Header decode_header(const Image& image) {
    return {.version = little_endian<std::uint32_t>(image, kVersionAt),
            .initialised = little_endian<std::uint32_t>(image, kInitialisedAt) != 0,
            .counter = little_endian<std::uint32_t>(image, kCounterAt)};
}

Expected<Layout> layout_of(const Header& header) {
    const auto* const found = std::ranges::find(kLayouts, header.version, &Layout::version);
    if (found == kLayouts.end()) {
        std::string known;
        for (const Layout& layout : kLayouts) {
            fmt::format_to(std::back_inserter(known), "{}{} (build {})", known.empty() ? "" : ", ",
                           layout.version, layout.build);
        }
        return std::unexpected(
            Error{ErrorKind::NoDevice,
                  fmt::format("the eye service writes version {} of its file; known are {}: its "
                              "layout is not guessed. Please report the version and the headset's "
                              "build",
                              header.version, known)});
    }
    if (!header.initialised) {
        return std::unexpected(Error{ErrorKind::NoDevice,
                                     "the eye service has not initialised its file yet: waiting"});
    }
    return *found;
}

RecordBytes record_in(const Image& image, const Layout& layout) {
    return RecordBytes(image.data() + layout.record_at, kRecordBytes);
}

GazeRecord decode_record(RecordBytes bytes) {
    return {.time_s = std::bit_cast<double>(little_endian<std::uint64_t>(bytes, kTimeAt)),
            .filtered = rays(bytes, kFilteredAt, kFilteredVariancesAt),
            .before_fusion = rays(bytes, kBeforeFusionAt, kBeforeFusionVariancesAt),
            .fixation_m = vector(bytes, kFixationAt),
            .openness = {real(bytes, kOpennessAt), real(bytes, kOpennessAt + kFloatBytes)}};
}

}  // namespace gazeloop::drivers::steam_frame

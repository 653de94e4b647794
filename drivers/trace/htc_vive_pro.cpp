#include "drivers/trace/htc_vive_pro.h"

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>

#include "drivers/trace/row_clock.h"
#include "drivers/trace/trace_builder.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "htc-vive-pro";
constexpr std::string_view kTime = "time(100ns)";
constexpr std::array<std::string_view, 17> kColumns{
    kTime,
    "eye_valid_L",
    "openness_L",
    "gaze_origin_L.x(mm)",
    "gaze_origin_L.y(mm)",
    "gaze_origin_L.z(mm)",
    "gaze_direct_L.x",
    "gaze_direct_L.y",
    "gaze_direct_L.z",
    "eye_valid_R",
    "openness_R",
    "gaze_origin_R.x(mm)",
    "gaze_origin_R.y(mm)",
    "gaze_origin_R.z(mm)",
    "gaze_direct_R.x",
    "gaze_direct_R.y",
    "gaze_direct_R.z",
};
constexpr std::array<std::string_view, 6> kHelmetColumns{
    "helmet_pos_x", "helmet_pos_y", "helmet_pos_z", "helmet_rot_x", "helmet_rot_y", "helmet_rot_z",
};

struct EyeColumns {
    std::size_t valid;
    std::size_t openness;
    std::array<std::size_t, 3> origin;
    std::array<std::size_t, 3> direction;
};

EyeColumns eye_columns(const CsvTable& table, std::string_view side) {
    const std::string eye{side};
    EyeColumns columns{.valid = table.column("eye_valid_" + eye),
                       .openness = table.column("openness_" + eye),
                       .origin = {},
                       .direction = {}};
    for (const std::size_t i : {0U, 1U, 2U}) {
        const char axis = "xyz"[i];
        columns.origin[i] = table.column("gaze_origin_" + eye + "." + axis + "(mm)");
        columns.direction[i] = table.column("gaze_direct_" + eye + "." + axis);
    }
    return columns;
}

/// +X left, +Z forward to +X right, -Z forward: half a turn about +Y.
glm::dvec3 from_sranipal(CsvTable& table, const std::array<std::size_t, 3>& columns) {
    return {-table.number(columns[0]), table.number(columns[1]), -table.number(columns[2])};
}

gaze::EyeRay read_eye(CsvTable& table, const EyeColumns& columns) {
    constexpr std::int64_t kAllValid = 31;
    constexpr double kMetresPerMillimetre = 1e-3;
    gaze::EyeRay ray;
    ray.origin_m = from_sranipal(table, columns.origin) * kMetresPerMillimetre;
    const double openness = table.number(columns.openness);
    if (openness >= 0.0 && openness <= 1.0) {
        ray.openness = openness;
    }
    const bool vouched = table.integer(columns.valid) == kAllValid;
    const auto direction = gaze::unit(from_sranipal(table, columns.direction));
    ray.valid = vouched && direction.has_value();
    ray.direction = direction.value_or(gaze::kStraightAhead);
    return ray;
}

/// Unity's left-handed frame mirrored in z: positions change sign in z, and a mirror in z turns
/// rotations about x and y around, but not those about z.
gaze::Pose read_helmet(CsvTable& table, const std::array<std::size_t, 6>& columns) {
    const auto turn = [&](std::size_t column, const glm::dvec3& axis) {
        return glm::angleAxis(glm::radians(table.number(columns[column])), axis);
    };
    const glm::dquat unity =
        turn(4, {0.0, 1.0, 0.0}) * turn(3, {1.0, 0.0, 0.0}) * turn(5, {0.0, 0.0, 1.0});
    return {glm::normalize(glm::dquat{unity.w, -unity.x, -unity.y, unity.z}),
            {table.number(columns[0]), table.number(columns[1]), -table.number(columns[2])}};
}

std::optional<std::array<std::size_t, 6>> helmet_columns(const CsvTable& table) {
    if (!table.missing(kHelmetColumns).empty()) {
        return std::nullopt;
    }
    std::array<std::size_t, 6> columns{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i] = table.column(kHelmetColumns[i]);
    }
    return columns;
}

Expected<gaze::GazeTrace> read(CsvTable& table) {
    const gaze::PerEye<EyeColumns> eyes{eye_columns(table, "L"), eye_columns(table, "R")};
    const auto helmet = helmet_columns(table);
    RowClock clock(table.column(kTime), 100);
    TraceBuilder builder(table.name(), kName, "HTC Vive Pro");

    std::uint64_t row = 0;
    while (true) {
        const Expected<bool> more = table.next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            return builder.finish();
        }
        gaze::GazeSample sample;
        sample.sequence = row++;
        sample.device_ns = clock.since_first_ns(table);
        sample.sampled = {sample.device_ns, time::StampKind::Modelled};
        for (const gaze::Eye eye : gaze::kEyes) {
            sample.eyes[gaze::index(eye)] = read_eye(table, eyes[gaze::index(eye)]);
        }
        if (helmet) {
            sample.head = read_helmet(table, *helmet);
        }
        builder.add(sample);
    }
}

constexpr TraceFormat kFormat{kName, kColumns, read};

}  // namespace

const TraceFormat& htc_vive_pro() { return kFormat; }

}  // namespace gazeloop::drivers

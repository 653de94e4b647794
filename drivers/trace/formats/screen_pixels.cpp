#include "drivers/trace/formats/screen_pixels.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/screen_sidecar.h"
#include "drivers/trace/trace_rows.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "screen-px";
constexpr std::array<std::string_view, 3> kColumns{"t_ms", "x_px", "y_px"};
constexpr std::array<ColumnNames, 1> kAll{kColumns};
constexpr std::array<std::span<const ColumnNames>, 1> kNeeded{kAll};
EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    return {
        table,
        eye,
        {.valid = {},
         .direction = {"x_px", "y_px"},
         .origin = {},
         .openness = {},
         .confidence = {}},
        // The screen's geometry makes the direction, once both numbers are there.
        {.direction =
             [](const glm::dvec3& point_px) { return glm::dvec3{point_px.x, point_px.y, -1.0}; },
         .bits = {}}};
}

/// Where on the screen the gaze is, as far as it tells pixels from shares of the screen.
class Places {
  public:
    void add(const glm::dvec2& point) {
        constexpr double kBeyond = 1.0;  // gaze leaves the screen a little
        const auto is_share = [](double x) { return x >= -kBeyond && x <= 1.0 + kBeyond; };
        ++points_;
        shares_ += is_share(point.x) && is_share(point.y) ? 1 : 0;
        const bool moved = last_ && *last_ != point;
        between_ += moved && point.x != std::floor(point.x) ? 1 : 0;
        last_ = point;
    }
    /// Nearly all, and they are no marks of losses such as 0,0 and -1,-1.
    [[nodiscard]] bool look_like_shares() const {
        constexpr std::uint64_t kFewest = 16;
        return points_ >= kFewest && shares_ * 100 >= points_ * 99 && 2 * between_ > points_;
    }

  private:
    std::uint64_t points_ = 0;
    std::uint64_t shares_ = 0;
    std::uint64_t between_ = 0;  ///< points that move and lie between whole numbers
    std::optional<glm::dvec2> last_;
};

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& file, const ReadOptions& options) {
    const Expected<ScreenSidecar> sidecar = read_screen_sidecar(file, table.name());
    if (!sidecar) {
        return std::unexpected(sidecar.error());
    }
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const std::size_t time = *table.column("t_ms");
    const std::size_t x = *table.column("x_px");
    const std::size_t y = *table.column("y_px");
    const double parallax_rad = combined_parallax_rad(sidecar->screen.distance_m());
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "tracker at a screen"});
    Places places;
    auto trace = rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 6, "milliseconds");
        row.parallax_rad = parallax_rad;
        const auto x_px = table.real(x);
        const auto y_px = table.real(y);
        if (!x_px || !y_px) {
            return;
        }
        if (sidecar->zero_is_missing && *x_px == 0.0 && *y_px == 0.0) {
            rows.refuse_eyes(row, "x and y are 0,0");
            return;
        }
        places.add({*x_px, *y_px});
        if (const auto loss = sidecar->screen.loss_at({*x_px, *y_px}); !loss.empty()) {
            rows.lose_eyes(row, loss);
            return;
        }
        const auto direction = gaze::unit(sidecar->screen.direction({*x_px, *y_px}));
        if (!direction) {
            rows.refuse_eyes(row, "a point too far from the screen for a direction");
            return;
        }
        for (gaze::EyeRay& ray : row.eyes) {
            ray.valid = true;
            ray.direction = *direction;
        }
    });
    if (trace && places.look_like_shares()) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}:{}: x_px and y_px go from 0 to 1, as shares of the screen do: "
                              "multiply them by its {} x {} pixels",
                              table.name(), table.header_line(), sidecar->screen.size_px.x,
                              sidecar->screen.size_px.y)});
    }
    return trace;
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& screen_pixels() { return kFormat; }

}  // namespace gazeloop::drivers

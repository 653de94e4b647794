#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "drivers/trace/bad_cells.h"
#include "drivers/trace/clock/trace_row.h"
#include "drivers/trace/screen_geometry.h"
#include "drivers/trace/text/csv_table.h"
#include "runtime/error.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// One eye's recording of BIDS, row by row.
class EyeRecording {
  public:
    /// Opens the table and reads what stands beside it. Errors: as read_bids has them.
    [[nodiscard]] static Expected<EyeRecording> open(const std::filesystem::path& file);

    /// Goes to the next row; false at the end.
    [[nodiscard]] Expected<bool> next(BadCells& bad);

    /// The current row, with the eyes that this is a recording of.
    [[nodiscard]] const TraceRow& row() const { return row_; }
    [[nodiscard]] bool is_of(gaze::Eye eye) const { return of_[gaze::index(eye)]; }
    [[nodiscard]] const std::string& device() const { return device_; }
    [[nodiscard]] double stated_rate_hz() const { return rate_hz_; }  ///< > 0
    [[nodiscard]] double time_unit_ns() const;  ///< of the timestamps' numbers
    [[nodiscard]] const std::string& unread_time() const { return unread_time_; }

    void report_to(gaze::TraceReport& report) const;

  private:
    enum class System { Screen_px, Screen_m, Head };
    /// From a time to a time, ns, or from a row to a row, counted from 0.
    struct Blink {
        std::int64_t begin;
        std::int64_t end;
    };

    explicit EyeRecording(std::unique_ptr<std::ifstream> in, CsvTable table)
        : in_(std::move(in)), table_(std::move(table)) {}
    [[nodiscard]] Expected<void> take_units(const nlohmann::json& physio,
                                            const nlohmann::json& events);
    void find_columns();
    [[nodiscard]] Expected<void> read_blinks(const std::filesystem::path& file);
    [[nodiscard]] glm::dvec3 direction(double x, double y) const;
    void read_eye(BadCells& bad);
    [[nodiscard]] double fraction(std::optional<std::size_t> column, RowDetail detail,
                                  gaze::Eye eye, BadCells& bad);
    [[nodiscard]] glm::dvec3 place(gaze::Eye eye, BadCells& bad);
    void read_head(BadCells& bad);
    [[nodiscard]] bool in_blink() const;

    std::unique_ptr<std::ifstream> in_;  // stays where it is, for the table
    CsvTable table_;
    gaze::PerEye<bool> of_{};
    std::string device_;
    int time_decimals_ = 9;
    std::string time_unit_;
    System system_ = System::Head;
    double per_unit_ = 1.0;  ///< metres or radians
    ScreenGeometry screen_;
    std::optional<std::size_t> openness_;
    std::optional<std::size_t> confidence_;
    std::optional<std::array<std::size_t, 3>> origin_;
    std::optional<std::array<std::size_t, 7>> head_;
    memory::LongVector<Blink> blinks_;  ///< by their beginnings
    bool blinks_by_row_ = false;        ///< else by time
    double rate_hz_ = 0.0;              ///< as the sidecar states it
    std::int64_t row_number_ = -1;      ///< of the current row
    TraceRow row_;
    std::string unread_time_;
    std::uint64_t in_blinks_ = 0;
    std::uint64_t first_in_blink_ = 0;
};

}  // namespace gazeloop::drivers

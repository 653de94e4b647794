#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/trace/bad_cells.h"
#include "drivers/trace/text/csv_table.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// The columns of one eye, by name. Those whose names are empty no file has.
struct EyeColumnNames {
    std::string valid;                   ///< empty: the format has none
    std::vector<std::string> direction;  ///< two or three
    std::array<std::string, 3> origin;
    std::string openness;
    std::string confidence;
};

/// What a row vouches for in an eye.
struct EyeTrust {
    bool direction = false;
    bool origin = false;
    bool openness = false;
};

/// How a format writes an eye.
struct EyeForm {
    /// What the validity cell in this column vouches for; none where the format has no such
    /// number. Null: the format has no validity, and an eye is vouched for where one of its
    /// direction's cells holds something.
    std::optional<EyeTrust> (*trust)(CsvTable& table, std::size_t valid) = nullptr;
    glm::dvec3 to_our_axes{1.0};  ///< factors of x, y and z
    double metre = 1.0;           ///< per unit of the origin
    /// Makes a direction in our axes of the numbers in the direction's columns, of which the third
    /// is 0 where there are two. Null: to_our_axes does.
    glm::dvec3 (*direction)(const glm::dvec3& numbers) = nullptr;
    /// The validity cell's bits for direction, origin and openness; none where it has no bits.
    std::optional<std::array<int, 3>> bits;
};

/// Reads one eye of a table's rows and counts what is refused. Only the direction and whether it is
/// valid are needed. An eye that the row does not vouch for may have anything in its cells. In one
/// that it does, a direction that cannot be read makes the eye invalid and counts as bad cells;
/// another number is unknown where it cannot be read or is missing, and counts too: a missing one
/// where other rows have it.
class EyeCells {
  public:
    /// An eye whose direction or validity the table lacks is never valid, which is noted: as
    /// NotRead where the table has other columns of it.
    EyeCells(CsvTable& table, gaze::Eye eye, const EyeColumnNames& names, const EyeForm& form);

    /// The eye in the table's current row.
    [[nodiscard]] gaze::EyeRay read(CsvTable& table, BadCells& bad);

    /// Adds what the tracker's bits did not vouch for, and directions of another length than 1.
    void report_to(gaze::TraceReport& report) const;

  private:
    /// What the row vouches for; none where its validity cannot be read.
    [[nodiscard]] std::optional<EyeTrust> trust(CsvTable& table, BadCells& bad) const;
    void count_refusals(const EyeTrust& trust, std::uint64_t line);
    void read_direction(CsvTable& table, bool vouched, gaze::EyeRay& ray, BadCells& bad);
    /// The direction's cell that is farthest from zero, in words.
    [[nodiscard]] std::string described(CsvTable& table) const;
    [[nodiscard]] glm::dvec3 read_origin(CsvTable& table, bool counts, BadCells& bad) const;
    [[nodiscard]] double read_fraction(CsvTable& table, std::size_t column, RowDetail detail,
                                       bool counts, BadCells& bad) const;

    struct Refused {
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
    };

    gaze::Eye eye_;
    EyeForm form_;
    std::optional<std::size_t> valid_;
    std::vector<std::size_t> direction_;  ///< empty: the table lacks the eye
    std::optional<std::array<std::size_t, 3>> origin_;
    std::optional<std::size_t> openness_;
    std::optional<std::size_t> confidence_;
    std::array<Refused, 3> refused_{};  ///< direction, origin, openness
    struct OtherLength {
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
        double first = 0.0;
    };
    OtherLength other_length_;
};

}  // namespace gazeloop::drivers

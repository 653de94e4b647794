#include "drivers/trace/eye_cells.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "drivers/trace/directions.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

/// Directions this close to unit length are taken as they are, so that what was written is read
/// back exactly.
constexpr double kUnitTolerance = 1e-9;

/// Directions further off unit length are more than rounded to a few digits.
constexpr double kLengthTolerance = 0.05;

constexpr double kUnknown = -1.0;

std::array<std::string_view, 3> views(const std::array<std::string, 3>& names) {
    return {names[0], names[1], names[2]};
}

std::string_view name_of(gaze::Eye eye) { return gaze::kEyeNames[gaze::index(eye)]; }

/// Whether a table has something of an eye beside its direction.
bool has_more(const CsvTable& table, const EyeColumnNames& names) {
    const auto has = [&](const std::string& name) { return !name.empty() && table.has(name); };
    return has(names.valid) || has(names.openness) || has(names.confidence) ||
           std::ranges::any_of(names.origin, has);
}

}  // namespace

EyeCells::EyeCells(CsvTable& table, gaze::Eye eye, const EyeColumnNames& names, const EyeForm& form)
    : eye_(eye), form_(form) {
    const auto optional = [&](const std::string& name) {
        return name.empty() ? std::nullopt : table.column(name);
    };
    std::vector<std::string_view> needed(names.direction.begin(), names.direction.end());
    if (form.trust != nullptr) {
        needed.emplace_back(names.valid);
    }
    if (const std::vector<std::string_view> lacking = table.missing(needed); !lacking.empty()) {
        if (lacking.size() < needed.size() || has_more(table, names)) {
            table.note(table.header_line(),
                       fmt::format("no {} eye, although other columns of it are there: it lacks "
                                   "'{}'",
                                   name_of(eye), fmt::join(lacking, "', '")),
                       gaze::TraceFindingKind::NotRead);
        } else {
            table.note(
                table.header_line(),
                fmt::format("no {} eye, for want of its direction{}", name_of(eye),
                            names.valid.empty() ? "" : fmt::format(" or '{}'", names.valid)));
        }
        return;
    }
    for (const std::string& name : names.direction) {
        direction_.push_back(*table.column(name));
    }
    valid_ = optional(names.valid);
    origin_ = table.columns(views(names.origin), fmt::format("the {} eye's origin", name_of(eye)));
    openness_ = optional(names.openness);
    confidence_ = optional(names.confidence);
}

gaze::EyeRay EyeCells::read(CsvTable& table, BadCells& bad) {
    gaze::EyeRay ray;
    if (direction_.empty()) {
        return ray;
    }
    const std::optional<EyeTrust> written = trust(table, bad);
    if (written) {
        count_refusals(*written, table.line());
    }
    const EyeTrust vouched = written.value_or(EyeTrust{});
    read_direction(table, vouched.direction, ray, bad);
    if (origin_ && vouched.origin) {
        ray.origin_m = read_origin(table, vouched.direction, bad);
    }
    if (openness_ && vouched.openness) {
        ray.openness = read_fraction(table, *openness_, openness_of(eye_), vouched.direction, bad);
    }
    if (confidence_) {
        ray.confidence =
            read_fraction(table, *confidence_, confidence_of(eye_), vouched.direction, bad);
    }
    return ray;
}

std::optional<EyeTrust> EyeCells::trust(CsvTable& table, BadCells& bad) const {
    // A row may hold nothing at all of an eye.
    const auto no_direction = [&] {
        return std::all_of(direction_.begin(), direction_.end(),
                           [&](std::size_t column) { return table.is_missing(column); });
    };
    if (form_.trust == nullptr) {
        const bool there = !no_direction();
        return EyeTrust{.direction = there, .origin = true, .openness = true};
    }
    if (const std::optional<EyeTrust> vouched = form_.trust(table, *valid_)) {
        return vouched;
    }
    if (!table.is_missing(*valid_) || !no_direction()) {
        const auto what = [&] {
            return fmt::format("{} does not say whether the eye is valid",
                               table.described(*valid_));
        };
        if (table.is_missing(*valid_)) {
            bad.add(direction_of(eye_), table.line(), what);
        } else {
            bad.add_not_understood(eye_, table.line(), what);
        }
    }
    return std::nullopt;
}

void EyeCells::count_refusals(const EyeTrust& trust, std::uint64_t line) {
    if (!form_.bits) {
        return;
    }
    const std::array<bool, 3> refuses{!trust.direction, origin_ && !trust.origin,
                                      openness_ && !trust.openness};
    for (std::size_t i = 0; i < refuses.size(); ++i) {
        if (refuses[i] && refused_[i].rows++ == 0) {
            refused_[i].first_line = line;
        }
    }
}

void EyeCells::read_direction(CsvTable& table, bool vouched, gaze::EyeRay& ray, BadCells& bad) {
    glm::dvec3 numbers{0.0};
    glm::dvec3 written = ray.direction;
    std::optional<std::size_t> unreadable;
    for (std::size_t i = 0; i < direction_.size(); ++i) {
        const std::size_t column = direction_[i];
        if (const std::optional<double> value = table.real(column)) {
            const int at = static_cast<int>(i);
            numbers[at] = *value;
            written[at] = form_.to_our_axes[at] * *value;
        } else if (!unreadable) {
            unreadable = column;
        }
    }
    if (form_.direction != nullptr) {
        written = unreadable ? ray.direction : form_.direction(numbers);
    }
    ray.direction = written;
    if (!vouched) {
        return;
    }
    if (unreadable) {
        const auto what = [&] {
            return fmt::format("{} is no number", table.described(*unreadable));
        };
        if (table.is_missing(*unreadable)) {
            bad.add(direction_of(eye_), table.line(), what);
        } else {
            bad.add_not_understood(eye_, table.line(), what);
        }
        return;
    }
    if (std::abs(glm::length(written) - 1.0) <= kUnitTolerance) {
        ray.valid = true;
    } else if (form_.direction != nullptr ? gaze::unit(written).has_value()
                                          : is_direction(written)) {
        ray.valid = true;
        ray.direction = *gaze::unit(written);
        const double length = glm::length(written);
        if (form_.direction == nullptr && std::abs(length - 1.0) > kLengthTolerance &&
            other_length_.rows++ == 0) {
            other_length_.first_line = table.line();
            other_length_.first = length;
        }
    } else {
        bad.add(direction_of(eye_), table.line(), [&] {
            return written == glm::dvec3{0.0} ? std::string{"a direction without length (0, 0, 0)"}
                   : form_.direction != nullptr
                       ? fmt::format("{} is an angle beyond a full turn", described(table))
                       : fmt::format("{} is beyond any direction", described(table));
        });
    }
}

std::string EyeCells::described(CsvTable& table) const {
    const std::size_t farthest = *std::ranges::max_element(direction_, {}, [&](std::size_t column) {
        return std::abs(table.real(column).value_or(0.0));
    });
    return table.described(farthest);
}

glm::dvec3 EyeCells::read_origin(CsvTable& table, bool counts, BadCells& bad) const {
    glm::dvec3 origin_m{0.0};
    bool complete = true;
    for (const int i : {0, 1, 2}) {
        const std::size_t column = (*origin_)[static_cast<std::size_t>(i)];
        if (const std::optional<double> value = table.real(column)) {
            origin_m[i] = form_.to_our_axes[i] * *value * form_.metre;
            continue;
        }
        complete = false;
        if (!counts) {
            continue;
        }
        if (table.is_missing(column)) {
            bad.lacks(origin_of(eye_), table.line(), [&] { return table.described(column); });
        } else {
            bad.add(other_of(eye_), table.line(),
                    [&] { return fmt::format("{} is no number", table.described(column)); });
        }
    }
    if (!complete) {
        return glm::dvec3{0.0};
    }
    bad.has(origin_of(eye_));
    return origin_m;
}

double EyeCells::read_fraction(CsvTable& table, std::size_t column, RowDetail detail, bool counts,
                               BadCells& bad) const {
    const std::optional<double> value = table.real(column);
    if (value && (*value == kUnknown || (*value >= 0.0 && *value <= 1.0))) {
        bad.has(detail);
        return *value;
    }
    if (counts && table.is_missing(column)) {
        bad.lacks(detail, table.line(), [&] { return table.described(column); });
    } else if (counts) {
        bad.add(other_of(eye_), table.line(), [&] {
            return fmt::format("{} is neither 0 to 1 nor -1 (unknown)", table.described(column));
        });
    }
    return kUnknown;
}

void EyeCells::report_to(gaze::TraceReport& report) const {
    constexpr std::array<std::string_view, 3> kNames{"direction", "origin", "openness"};
    for (std::size_t i = 0; i < refused_.size(); ++i) {
        if (refused_[i].rows > 0) {
            report.add(
                {.kind = gaze::TraceFindingKind::RefusedByBit,
                 .line = refused_[i].first_line,
                 .rows = refused_[i].rows,
                 .text = fmt::format("{} eye: {} not vouched for in {} {} (validity bit {})",
                                     name_of(eye_), kNames[i], refused_[i].rows,
                                     refused_[i].rows == 1 ? "row" : "rows", (*form_.bits)[i])});
        }
    }
    if (other_length_.rows > 0) {
        report.add({.kind = gaze::TraceFindingKind::Text,
                    .line = other_length_.first_line,
                    .rows = other_length_.rows,
                    .text = fmt::format("{} eye: {} {} of another length than 1, the first of "
                                        "{:.3g}: taken for where they point",
                                        name_of(eye_), other_length_.rows,
                                        other_length_.rows == 1 ? "direction" : "directions",
                                        other_length_.first)});
    }
}

}  // namespace gazeloop::drivers

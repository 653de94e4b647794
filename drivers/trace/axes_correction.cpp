#include "drivers/trace/axes_correction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/gaze/anatomy.h"

namespace gazeloop::drivers {
namespace {

using gaze::AnatomyVerdict;

std::string_view name_of(AxesCorrection correction) {
    return kAxesCorrectionNames[static_cast<std::size_t>(correction)];
}

void mirror_x(std::span<gaze::GazeSample> samples) {
    const AnatomyVerdict before = gaze::anatomy_of(samples).verdict;
    const bool places =
        before == AnatomyVerdict::Exchanged || before == AnatomyVerdict::PlacesExchanged;
    const bool directions = before != AnatomyVerdict::PlacesExchanged;
    for (gaze::GazeSample& sample : samples) {
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.direction.x *= directions ? -1.0 : 1.0;
            ray.origin_m.x *= places ? -1.0 : 1.0;
        }
    }
}

void mirror_z(std::span<gaze::GazeSample> samples) {
    for (gaze::GazeSample& sample : samples) {
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.direction.z *= -1.0;
        }
    }
}

/// Enough of a trace to try a correction on.
std::vector<gaze::GazeSample> some_of(std::span<const gaze::GazeSample> samples) {
    constexpr std::size_t kMost = 5'000;
    const std::size_t step = samples.size() / kMost + 1;
    std::vector<gaze::GazeSample> some;
    for (std::size_t i = 0; i < samples.size(); i += step) {
        some.push_back(samples[i]);
    }
    return some;
}

/// The corrections after which nothing is wrong; where it can be told, after which all is right.
std::vector<AxesCorrection> helping(std::span<const gaze::GazeSample> samples) {
    const std::vector<gaze::GazeSample> some = some_of(samples);
    std::vector<AxesCorrection> right;
    std::vector<AxesCorrection> not_wrong;
    for (const AxesCorrection correction : {AxesCorrection::MirrorX, AxesCorrection::SwapEyes,
                                            AxesCorrection::MirrorZ, AxesCorrection::MirrorXZ}) {
        std::vector<gaze::GazeSample> corrected = some;
        correct_axes(corrected, correction);
        const gaze::Anatomy anatomy = gaze::anatomy_of(corrected);
        if (anatomy.verdict == AnatomyVerdict::Agrees) {
            right.push_back(correction);
        } else if (!anatomy.doubtful()) {
            not_wrong.push_back(correction);
        }
    }
    return right.empty() ? not_wrong : right;
}

/// What each correction is for, where more than one would help.
std::string_view when(AxesCorrection correction) {
    switch (correction) {
        case AxesCorrection::None:
            break;
        case AxesCorrection::MirrorX:
            return "if a look to the left moves the gaze right";
        case AxesCorrection::SwapEyes:
            return "if the columns of the eyes are exchanged";
        case AxesCorrection::MirrorZ:
            return "if left and right are right";
        case AxesCorrection::MirrorXZ:
            return "if they are exchanged too";
    }
    return "";
}

std::string remedy(std::span<const gaze::GazeSample> samples, AxesCorrection in_use) {
    if (in_use != AxesCorrection::None) {
        return fmt::format(
            "--axes {} makes it so or does not help: look at the trace without it "
            "(gazeloop gaze)",
            name_of(in_use));
    }
    const std::vector<AxesCorrection> offered = helping(samples);
    if (offered.empty()) {
        return "no --axes mends it: correct the file where it was made";
    }
    if (offered.size() == 1) {
        return fmt::format("--axes {} makes it agree", name_of(offered.front()));
    }
    std::string text;
    for (const AxesCorrection correction : offered) {
        text += fmt::format("{}--axes {} {}", text.empty() ? "" : ", ", name_of(correction),
                            when(correction));
    }
    return text;
}

}  // namespace

AxesCorrection axes_correction_named(std::string_view name) {
    return static_cast<AxesCorrection>(std::ranges::find(kAxesCorrectionNames, name) -
                                       kAxesCorrectionNames.begin());
}

void correct_axes(std::span<gaze::GazeSample> samples, AxesCorrection correction) {
    switch (correction) {
        case AxesCorrection::None:
            break;
        case AxesCorrection::MirrorX:
            mirror_x(samples);
            break;
        case AxesCorrection::SwapEyes:
            for (gaze::GazeSample& sample : samples) {
                std::swap(sample.eyes[0], sample.eyes[1]);
            }
            break;
        case AxesCorrection::MirrorZ:
            mirror_z(samples);
            break;
        case AxesCorrection::MirrorXZ:
            mirror_z(samples);
            mirror_x(samples);
            break;
    }
}

namespace {

/// What is odd about how far apart the eyes are; nothing if they are as people's.
std::string odd_distance(const gaze::Anatomy& anatomy) {
    constexpr double kLeast_m = 0.045;
    constexpr double kMost_m = 0.080;
    const double apart_m = std::abs(anatomy.apart_m.value_or(0.0));
    if (apart_m == 0.0 || (apart_m >= kLeast_m && apart_m <= kMost_m)) {
        return {};
    }
    struct Unit {
        double per_metre;
        std::string_view name;
    };
    for (const Unit& unit : {Unit{1e3, "millimetres"}, Unit{1e2, "centimetres"}}) {
        if (apart_m >= kLeast_m * unit.per_metre && apart_m <= kMost_m * unit.per_metre) {
            return fmt::format(
                "origins look like {}, the eyes would be {:.3g} m apart: write them "
                "in metres",
                unit.name, apart_m);
        }
    }
    return fmt::format(
        "origins are {:.3g} mm apart, eyes are {:.0f} to {:.0f} mm: look at their "
        "unit and columns",
        apart_m * 1e3, kLeast_m * 1e3, kMost_m * 1e3);
}

/// What is odd about parts of a recording that as a whole agrees with anatomy: the eyes' rays meet
/// in most of it and diverge by as much in the rest. Nothing where that is not so.
std::string odd_part(std::span<const gaze::GazeSample> samples, const gaze::Anatomy& whole) {
    constexpr std::size_t kParts = 10;
    constexpr double kLeast_deg = 1.0;
    if (whole.doubtful() || !whole.vergence_deg) {
        return {};
    }
    const double apart_deg = std::max(kLeast_deg, whole.vergence_deg->median / 2.0);
    std::size_t odd = 0;
    std::int64_t first_ns = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t begin = samples.size() * part / kParts;
        const std::size_t end = samples.size() * (part + 1) / kParts;
        const gaze::Anatomy anatomy = gaze::anatomy_of(samples.subspan(begin, end - begin));
        if (anatomy.vergence_deg && anatomy.vergence_deg->median < -apart_deg &&
            anatomy.vergence_deg->upper < 0.0) {
            first_ns = odd++ == 0 ? samples[begin].sampled.ns : first_ns;
        }
    }
    return odd == 0 ? ""
                    : fmt::format(
                          "the eyes' rays meet in most of the recording and diverge in {} "
                          "of its {} parts, the first from {:.1f} s on: left and right are "
                          "exchanged there, it seems; split the file",
                          odd, kParts, static_cast<double>(first_ns) * 1e-9);
}

/// Rows with an eye that looks behind the head.
struct BehindHead {
    gaze::PerEye<std::uint64_t> eyes{};
    std::uint64_t rows = 0;
    std::uint64_t first_line = 0;
    std::uint64_t samples = 0;                     ///< with gaze, behind or not
    gaze::PerEye<std::uint64_t> all_directions{};  ///< behind or not

    /// One eye's axes are others all along, and the other's are not.
    [[nodiscard]] bool is_one_eye() const {
        return (eyes[0] == all_directions[0] && eyes[1] == 0) ||
               (eyes[1] == all_directions[1] && eyes[0] == 0);
    }
};

/// No eye turns so far: what points there is invalid.
BehindHead take_out_behind(gaze::GazeTrace& trace) {
    BehindHead behind;
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        gaze::PerEye<gaze::EyeRay>& eyes = trace.samples[i].eyes;
        behind.samples += eyes[0].valid || eyes[1].valid ? 1 : 0;
        bool any = false;
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = eyes[gaze::index(eye)];
            behind.all_directions[gaze::index(eye)] += ray.valid ? 1 : 0;
            if (ray.valid && ray.direction.z > 0.0) {
                ray.valid = false;
                ++behind.eyes[gaze::index(eye)];
                any = true;
            }
        }
        if (!any) {
            continue;
        }
        if (behind.rows++ == 0 && !trace.lines.empty()) {
            behind.first_line = trace.lines[i];
        }
    }
    for (const std::size_t e : {0U, 1U}) {
        std::uint64_t& valid = trace.report.valid[e];
        valid -= std::min(valid, behind.eyes[e]);
    }
    return behind;
}

std::string rows_text(std::uint64_t rows) {
    return fmt::format("{} {}", rows, rows == 1 ? "row" : "rows");
}

std::string at_line(const gaze::GazeTrace& trace, std::uint64_t line) {
    return line > 0 ? fmt::format("{}:{}", trace.file, line) : trace.file;
}

/// Reports them; more than a tenth of the gaze is too much to do without.
Expected<void> report_behind(gaze::GazeTrace& trace, const BehindHead& behind,
                             bool accept_repairs) {
    constexpr std::uint64_t kRowsPerRepair = 10;
    if (behind.rows == 0) {
        return {};
    }
    const std::uint64_t all = behind.all_directions[0] + behind.all_directions[1];
    if (!accept_repairs && (behind.eyes[0] + behind.eyes[1]) * kRowsPerRepair > all &&
        !behind.is_one_eye()) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: in {} of {} rows gaze points behind the head (+Z), the first of "
                        "them here; turn the Z axis of these rows, or --accept-repairs plays the "
                        "others",
                        at_line(trace, behind.first_line), behind.rows, behind.samples)});
    }
    trace.report.add(
        {.kind = gaze::TraceFindingKind::BehindHead,
         .line = behind.first_line,
         .rows = behind.rows,
         .text = fmt::format("gaze points behind the head (+Z): left eye in {}, right eye in {}: "
                             "the eye is invalid there",
                             rows_text(behind.eyes[0]), rows_text(behind.eyes[1]))});
    return {};
}

}  // namespace

Expected<void> hold_against_anatomy(gaze::GazeTrace& trace, AxesCorrection correction,
                                    bool accept_repairs) {
    correct_axes(trace.samples, correction);
    gaze::Anatomy anatomy = gaze::anatomy_of(trace.samples);
    if (anatomy.verdict != AnatomyVerdict::Behind) {
        const BehindHead behind = take_out_behind(trace);
        if (auto reported = report_behind(trace, behind, accept_repairs); !reported) {
            return reported;
        }
        if (behind.rows > 0) {
            anatomy = gaze::anatomy_of(trace.samples);
        }
    }
    std::string text = gaze::anatomy_text(anatomy);
    if (correction != AxesCorrection::None) {
        text = fmt::format("corrected by --axes {}: {}", name_of(correction), text);
    }
    const std::string odd = odd_distance(anatomy);
    trace.report.axes = odd.empty() ? text : text + "; but " + odd;
    if (!odd.empty()) {
        trace.report.add(
            {.kind = gaze::TraceFindingKind::Axes, .rows = trace.samples.size(), .text = odd});
    }
    if (std::string part = odd_part(trace.samples, anatomy); !part.empty()) {
        trace.report.axes += "; but " + part;
        trace.report.add({.kind = gaze::TraceFindingKind::Axes,
                          .rows = trace.samples.size(),
                          .text = std::move(part)});
    }
    if (anatomy.doubtful()) {
        text += "; " + remedy(trace.samples, correction);
    }
    if (anatomy.verdict == AnatomyVerdict::Behind) {
        return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", trace.file, text)});
    }
    if (anatomy.doubtful() || correction != AxesCorrection::None) {
        trace.report.add({.kind = gaze::TraceFindingKind::Axes,
                          .rows = trace.samples.size(),
                          .text = std::move(text)});
    }
    return {};
}

}  // namespace gazeloop::drivers

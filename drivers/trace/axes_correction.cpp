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

/// What a correction does whatever the samples are.
AxesChange turned_by(AxesCorrection correction) {
    return {.swap_eyes = correction == AxesCorrection::SwapEyes,
            .mirror_directions_z =
                correction == AxesCorrection::MirrorZ || correction == AxesCorrection::MirrorXZ};
}

/// What it mirrors too, of samples that were turned by it.
void add_mirrored(const gaze::SampleRange& turned, AxesCorrection correction, AxesChange& change) {
    if (correction != AxesCorrection::MirrorX && correction != AxesCorrection::MirrorXZ) {
        return;
    }
    const AnatomyVerdict before = gaze::anatomy_of(turned).verdict;
    change.mirror_places_x =
        before == AnatomyVerdict::Exchanged || before == AnatomyVerdict::PlacesExchanged;
    change.mirror_directions_x = before != AnatomyVerdict::PlacesExchanged;
}

void apply_to_all(const AxesChange& change, std::span<gaze::GazeSample> samples) {
    for (gaze::GazeSample& sample : samples) {
        change.apply_to(sample);
    }
}

/// Enough of a trace to try a correction on.
std::vector<gaze::GazeSample> some_of(const gaze::SampleRange& samples) {
    constexpr std::size_t kMost = 5'000;
    const std::size_t step = samples.size() / kMost + 1;
    std::vector<gaze::GazeSample> some;
    std::size_t i = 0;
    for (const gaze::GazeSample& sample : samples) {
        if (i++ % step == 0) {
            some.push_back(sample);
        }
    }
    return some;
}

/// The corrections after which nothing is wrong; where it can be told, after which all is right.
std::vector<AxesCorrection> helping(const gaze::SampleRange& samples) {
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

std::string remedy(const gaze::SampleRange& samples, AxesCorrection in_use) {
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
    apply_to_all(turned_by(correction), samples);
    AxesChange mirrored;
    add_mirrored(samples, correction, mirrored);
    apply_to_all(mirrored, samples);
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
/// in most of it and diverge by as much in the rest. Nothing where that is not so, as where they
/// only waver around parallel.
std::string odd_part(const gaze::SampleRange& samples, const gaze::Anatomy& whole) {
    constexpr std::size_t kParts = 10;
    constexpr double kLeast_deg = 1.0;
    constexpr std::size_t kMostBetween = 2;  // one at either end of what is exchanged
    if (whole.doubtful() || !whole.vergence_deg) {
        return {};
    }
    const double apart_deg = std::max(kLeast_deg, whole.vergence_deg->median / 2.0);
    std::size_t odd = 0;
    std::size_t between = 0;
    std::int64_t first_ns = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t begin = samples.size() * part / kParts;
        const std::size_t end = samples.size() * (part + 1) / kParts;
        const gaze::Anatomy anatomy = gaze::anatomy_of(samples.part(begin, end));
        if (anatomy.vergence_deg && anatomy.vergence_deg->median < -apart_deg &&
            anatomy.vergence_deg->upper < 0.0) {
            first_ns = odd++ == 0 ? samples[begin].sampled.ns : first_ns;
        } else if (anatomy.vergence_deg && anatomy.vergence_deg->median < apart_deg) {
            ++between;
        }
    }
    return odd == 0 || between > kMostBetween
               ? ""
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
BehindHead take_out_behind(BuiltTrace& trace) {
    BehindHead behind;
    std::size_t i = 0;
    for (const gaze::GazeSample& sample : gaze::SampleRange(*trace.samples)) {
        const gaze::PerEye<gaze::EyeRay>& eyes = sample.eyes;
        behind.samples += eyes[0].valid || eyes[1].valid ? 1 : 0;
        bool any = false;
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeRay& ray = eyes[gaze::index(eye)];
            behind.all_directions[gaze::index(eye)] += ray.valid ? 1 : 0;
            if (ray.valid && ray.direction.z > 0.0) {
                ++behind.eyes[gaze::index(eye)];
                any = true;
            }
        }
        if (any && behind.rows++ == 0) {
            behind.first_line = trace.lines[i];
        }
        ++i;
    }
    for (const std::size_t e : {0U, 1U}) {
        std::uint64_t& valid = trace.report.valid[e];
        valid -= std::min(valid, behind.eyes[e]);
    }
    AxesChange change = trace.samples->changed();
    change.nothing_behind = true;
    trace.samples->change(change);
    return behind;
}

std::string rows_text(std::uint64_t rows) {
    return fmt::format("{} {}", rows, rows == 1 ? "row" : "rows");
}

std::string at_line(const BuiltTrace& trace, std::uint64_t line) {
    return line > 0 ? fmt::format("{}:{}", trace.file, line) : trace.file;
}

/// Reports them; more than a tenth of the gaze is too much to do without.
Expected<void> report_behind(BuiltTrace& trace, const BehindHead& behind, bool accept_repairs) {
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

Expected<void> hold_against_anatomy(BuiltTrace& trace, AxesCorrection correction,
                                    bool accept_repairs) {
    const gaze::SampleRange samples(*trace.samples);
    AxesChange change = turned_by(correction);
    trace.samples->change(change);
    add_mirrored(samples, correction, change);
    trace.samples->change(change);
    gaze::Anatomy anatomy = gaze::anatomy_of(samples);
    if (anatomy.verdict != AnatomyVerdict::Behind) {
        const BehindHead behind = take_out_behind(trace);
        if (auto reported = report_behind(trace, behind, accept_repairs); !reported) {
            return reported;
        }
        if (behind.rows > 0) {
            anatomy = gaze::anatomy_of(samples);
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
            {.kind = gaze::TraceFindingKind::Axes, .rows = samples.size(), .text = odd});
    }
    if (std::string part = odd_part(samples, anatomy); !part.empty()) {
        trace.report.axes += "; but " + part;
        trace.report.add({.kind = gaze::TraceFindingKind::Axes,
                          .rows = samples.size(),
                          .text = std::move(part)});
    }
    if (anatomy.doubtful()) {
        text += "; " + remedy(samples, correction);
    }
    if (anatomy.verdict == AnatomyVerdict::Behind) {
        return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", trace.file, text)});
    }
    if (anatomy.doubtful() || correction != AxesCorrection::None) {
        trace.report.add({.kind = gaze::TraceFindingKind::Axes,
                          .rows = samples.size(),
                          .text = std::move(text)});
    }
    return {};
}

}  // namespace gazeloop::drivers

#pragma once

#include <array>
#include <span>
#include <string_view>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/read_options.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers {

/// As --axes has them, in the order of AxesCorrection.
inline constexpr std::array<std::string_view, 5> kAxesCorrectionNames{"none", "-x", "swap-eyes",
                                                                      "-z", "-x-z"};

/// The correction of that name. Precondition: there is one.
[[nodiscard]] AxesCorrection axes_correction_named(std::string_view name);

/// Turns directions and places of the eyes.
///
/// - MirrorX mirrors what is on the wrong side: the eyes' places where the left one lies right of
///   the right one; directions always, unless the places alone are wrong (the rays meet then).
/// - SwapEyes exchanges the eyes with all that is known of each.
/// - MirrorZ mirrors directions.
/// - MirrorXZ is MirrorZ, then MirrorX.
void correct_axes(std::span<gaze::GazeSample> samples, AxesCorrection correction);

/// Corrects a trace as asked, holds what comes of it against anatomy (gaze/anatomy.h) and puts the
/// result into its report: the line, and a finding where it is in doubt or was corrected, with each
/// correction that would help. Nothing is corrected unasked.
///
/// An eye that looks behind the head in less than half of the samples is made invalid there and
/// counted (BehindHead).
///
/// Errors (BadInput): half of the gaze or more points behind the head, and the correction that
/// would help is named; unless repairs are accepted, more than a tenth of the
/// directions points there, and not all of one eye's.
[[nodiscard]] Expected<void> hold_against_anatomy(BuiltTrace& trace, AxesCorrection correction,
                                                  bool accept_repairs = false);

}  // namespace gazeloop::drivers

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/fixed_text.h"

namespace gazeloop::session {

class OpenSession;

/// What a study shows from a frame on. `Text` holds text as its user needs it.
template <typename Text>
struct TrialRowOf {
    std::uint64_t first_frame = 0;
    std::uint32_t subject = 0;
    std::uint32_t trial = 0;
    std::uint32_t attempt = 0;
    std::uint32_t part = 0;    ///< of the trial: pictures and blacks
    Text screen{};             ///< "black", "picture", "question", "rest", "away", "over"
    bool follows_gaze = true;  ///< the foveae; else they are straight ahead
    Text method{};             ///< that draws it; empty: the display is black
    Text settings{};           ///< KEY=VALUE, with blanks between, beside those of `config`
};

/// What the subject answered.
template <typename Text>
struct ResponseRowOf {
    std::uint64_t frame = 0;  ///< that was shown next
    std::uint32_t subject = 0;
    std::uint32_t trial = 0;
    std::uint32_t attempt = 0;
    std::uint32_t session = 0;
    Text kind{};
    bool reference_first = true;
    Text
        levels{};  ///< one per factor, with commas between; empty: both pictures were the reference
    Text answer{};
    double after_s = 0.0;
    std::optional<double> settled{};
    Text fault{};
};

using TrialRow = TrialRowOf<std::string>;
using ResponseRow = ResponseRowOf<std::string>;
using TrialRecord = TrialRowOf<FixedText<240>>;
using ResponseRecord = ResponseRowOf<FixedText<120>>;

/// In the order in which they were recorded; empty for a session of no study. Errors (BadInput):
/// a damaged session (file, table and row named); first frames that decrease.
Expected<std::vector<TrialRow>> read_trials(const OpenSession& session);
Expected<std::vector<ResponseRow>> read_responses(const OpenSession& session);

// As in record_fields.h.

template <typename Visitor, typename Row>
void visit_trial(Visitor& visit, Row& row) {
    visit("first_frame", "", row.first_frame);
    visit("subject", "", row.subject);
    visit("trial", "", row.trial);
    visit("attempt", "", row.attempt);
    visit("part", "", row.part);
    visit("screen", "", row.screen);
    visit("follows_gaze", "", row.follows_gaze);
    visit("method", "", row.method);
    visit("settings", "", row.settings);
}

template <typename Visitor, typename Row>
void visit_response(Visitor& visit, Row& row) {
    visit("frame", "", row.frame);
    visit("subject", "", row.subject);
    visit("trial", "", row.trial);
    visit("attempt", "", row.attempt);
    visit("session", "", row.session);
    visit("kind", "", row.kind);
    visit("reference_first", "", row.reference_first);
    visit("levels", "", row.levels);
    visit("answer", "", row.answer);
    visit("after_s", "", row.after_s);
    visit("settled", "", row.settled);
    visit("fault", "", row.fault);
}

}  // namespace gazeloop::session

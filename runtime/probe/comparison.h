#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/latency/latency_summary.h"
#include "runtime/probe/event_to_photon.h"
#include "runtime/probe/measurement.h"
#include "runtime/session/open_session.h"

namespace gazeloop::probe {

/// A measured eye-to-photon beside what a session's stamps and profiles say of it.
struct Comparison {
    Measurement measured;
    EventToPhoton modelled;
    /// From the begin of a pixel's light to its middle: what a camera sees of a steady display
    /// comes so much before what the stamps count to. Unknown where the profile does not say; 0 for
    /// a pulsed display.
    std::optional<double> begin_to_middle_ms;

    /// The modelled mean as a camera would see it; where begin_to_middle_ms is unknown, to the
    /// middle of the light.
    [[nodiscard]] std::optional<double> expected_ms() const;
    /// Measured less expected; positive: longer than modelled.
    [[nodiscard]] std::optional<double> longer_by_ms() const;
};

/// Plays the session. `config` is that of its summary's report: which display times hold. Errors:
/// those of session::play.
[[nodiscard]] Expected<Comparison> compare(const Measurement& measured,
                                           const session::OpenSession& session,
                                           const latency::SummaryConfig& config);

/// For people, a block of its own; lines end in newlines.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);
/// For programs; null: unknown.
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace gazeloop::probe

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/report/fovea_path.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_summary.h"
#include "runtime/statistics/block_bootstrap.h"

namespace gazeloop::report {

/// One quantity of two sessions, in milliseconds, degrees or a count, as its unit is.
struct ComparedRow {
    RowName name;
    Unit unit = Unit::Nanoseconds;
    std::uint64_t frames_before = 0;
    std::uint64_t frames_after = 0;
    /// None: one of the two has too few frames for it, or its neighbours are too alike.
    std::optional<statistics::Difference> mean{};
    std::vector<std::optional<statistics::Difference>> percentiles{};  ///< as asked for
    std::string refused{};  ///< why the two say nothing of each other; empty: they do

    /// Whether some figure changed by more than chance explains.
    [[nodiscard]] bool changed() const;
};

/// Something that the two sessions do not have in common.
struct Disparity {
    std::string what;    ///< a setting's key, or what else differs
    std::string before;  ///< empty: it has none
    std::string after;
};

/// What another session's figures became in this one.
struct Comparison {
    statistics::BootstrapOptions options;
    std::vector<ComparedRow> rows;
    std::vector<Disparity> disparities;  ///< settings, devices and displays that differ
    std::vector<std::string> doubts;     ///< why the figures may mislead
    FoveaPathDifference path;
};

/// A session with what was read from it.
struct ComparedSession {
    const session::OpenSession& session;
    const SessionSummary& summary;
};

/// Errors (BadInput), each with its reason: one was timed and the other not; one has no frame whose
/// gaze has a known age; a damaged session.
Expected<Comparison> compare(const ComparedSession& before, const ComparedSession& after,
                             const Percentiles& percentiles,
                             const statistics::BootstrapOptions& options = {});

}  // namespace gazeloop::report

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// What one changed setting does to a method's pictures and their cost (worth_points.h).
struct PartWorth {
    std::string change;       ///< "kfr.disc=false"
    std::string error{};      ///< why it could not be rendered; all else is then empty
    bool takes_away = false;  ///< the change switches something off
    double time = 1.0;        ///< over that without the change, in the same turns
    /// Of three rounds or more those of both do not overlap, and it is by over 3 % another.
    bool time_is_clear = false;
    double cells = 1.0;  ///< shaded, over those without the change
    bool same = false;   ///< no figure changes in its last bit, so no pixel does
    double loss = 0.0;   ///< by the first figure, in its unit; positive: worse

    /// What to make of it, for people.
    [[nodiscard]] std::string verdict() const;
    /// What the change switches off costs time and shows in no figure.
    [[nodiscard]] bool is_needless() const {
        return takes_away && same && time_is_clear && time < 1.0;
    }
};

struct MethodWorth {
    std::string method;
    std::string figure;  ///< the first one's key
    bool still = false;  ///< of one frame, in which nothing that needs several can show
    std::vector<PartWorth> parts{};
};

/// Of the rows of such points, of one machine. None: they are of another sweep, or the method
/// itself failed.
[[nodiscard]] std::optional<MethodWorth> method_worth(const SweepSubject& subject,
                                                      const std::vector<SweepRow>& rows);

/// What is needless, and what the sweep could not show.
[[nodiscard]] std::string worth_note(const MethodWorth& worth);
/// A table and the note; lines end in newlines.
[[nodiscard]] std::string worth_text(const MethodWorth& worth);
[[nodiscard]] nlohmann::ordered_json worth_json(const MethodWorth& worth);

}  // namespace gazeloop::trade

#pragma once

#include <string>
#include <vector>

#include "runtime/cli/quality_options.h"
#include "runtime/command_line/command_line.h"
#include "runtime/trade/trade_off.h"

namespace gazeloop::cli {

/// The options of `trade`.
struct TradeOptions {
    QualityOptions quality;
    std::vector<std::string> gazes{"0,0"};  ///< see ComparedGaze::parse
    trade::TradeRequest asked{};

    void add_to(Command command);

    /// Without gazes. Throws SetupError (Usage) for a metric that there is not.
    [[nodiscard]] trade::TradeRequest request() const;
};

}  // namespace gazeloop::cli

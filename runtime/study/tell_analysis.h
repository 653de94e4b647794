#pragma once

#include <string>
#include <vector>

namespace gazeloop::study {

/// Whose answers are analysed, and where the result goes. Empty: nowhere; "-": stdout.
struct AnalysisRequest {
    std::string plan;                ///< a file
    std::vector<std::string> files;  ///< answers
    std::string json;
    std::string csv;    ///< a line per cell
    std::string r_csv;  ///< a line per decision, for R
    std::string html;
};

/// Says on stdout what the answers say, unless an output goes there, and writes what was asked for.
/// @throws SetupError: Usage for outputs that are not apart, BadInput for what cannot be read or
/// written
void tell_analysis(const AnalysisRequest& request);

}  // namespace gazeloop::study

#pragma once

#include <string>
#include <vector>

#include "runtime/study/people_question.h"

namespace gazeloop::study {

/// Which published studies are held against simulated people who see by the contrast metric.
struct PublishedRequest {
    PeopleQuestion people{};
    std::vector<std::string> trades{};  ///< results of trade --json
    std::string json{};                 ///< "-": stdout; empty: not asked for
};

/// Says on stdout what of the published studies the metric would have found, for each study whose
/// levels are all in one of the files, unless JSON goes there. @throws SetupError (BadInput): a
/// file has the levels of none; what cannot be read or written
void tell_published(const PublishedRequest& request);

}  // namespace gazeloop::study

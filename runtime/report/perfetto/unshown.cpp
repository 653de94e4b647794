#include "runtime/report/perfetto/unshown.h"

#include <fmt/format.h>

namespace gazeloop::report::perfetto {

std::vector<std::string> Unshown::texts() const {
    std::vector<std::string> texts;
    for (std::size_t why = 0; why < counts_.size(); ++why) {
        std::string parts;
        for (std::size_t subject = 0; subject < kSubjects; ++subject) {
            if (counts_[why][subject] > 0) {
                parts += fmt::format("{}{} of {}", parts.empty() ? "" : ", ", counts_[why][subject],
                                     kSubjectTexts[subject].name);
            }
        }
        if (!parts.empty()) {
            texts.push_back(fmt::format("{}: {}", kWhyUnshownTexts[why], parts));
        }
    }
    return texts;
}

}  // namespace gazeloop::report::perfetto

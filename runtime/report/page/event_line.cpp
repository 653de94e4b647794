#include "runtime/report/page/event_line.h"

#include <algorithm>
#include <utility>

namespace gazeloop::report::page {

void EventLine::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    auto found = std::ranges::find(kinds_, kind, &Kind::name);
    if (found == kinds_.end()) {
        if (kinds_.size() == kMostKinds) {
            ++others_;
            return;
        }
        kinds_.push_back({.name = std::string(kind), .weight = frame::weight_of(kind)});
        found = kinds_.end() - 1;
    }
    ++found->times;
    if (time.known()) {
        found->ns.push_back(time.ns);
    }
    if (found->texts.size() < kMostTexts) {
        std::string kept(text.substr(0, kLongestText));
        kept += text.size() > kLongestText ? " ... (cut)" : "";
        found->texts.push_back(
            {time.known() ? std::optional(time.ns) : std::nullopt, std::move(kept)});
    }
}

}  // namespace gazeloop::report::page

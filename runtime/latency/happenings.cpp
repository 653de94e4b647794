#include "runtime/latency/happenings.h"

#include <algorithm>

namespace gazeloop::latency {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether digits, or a sign or point before one, begin here.
bool begins_number(std::string_view text) {
    if (text.empty()) {
        return false;
    }
    const bool sign = text[0] == '-' || text[0] == '+' || text[0] == '.';
    return is_digit(text[0]) || (sign && text.size() > 1 && is_digit(text[1]));
}

std::string_view without_number(std::string_view text) {
    if (!is_digit(text[0])) {
        text.remove_prefix(1);
    }
    while (!text.empty() && (is_digit(text[0]) || (text[0] == '.' && begins_number(text)))) {
        text.remove_prefix(1);
    }
    return text;
}

}  // namespace

bool same_but_for_numbers(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        const bool number = begins_number(a);
        if (number != begins_number(b) || (!number && a[0] != b[0])) {
            return false;
        }
        a = number ? without_number(a) : a.substr(1);
        b = number ? without_number(b) : b.substr(1);
    }
    return a.empty() && b.empty();
}

std::size_t Happenings::add(const time::Stamp& time, std::string_view kind, std::string_view text) {
    const FixedText<32> kept_kind(kind);
    const FixedText<240> kept_text(text);
    auto* const end = all_.begin() + size_;
    auto* const found = std::find_if(all_.begin(), end, [&](const Happening& one) {
        return one.kind.view() == kept_kind.view() &&
               same_but_for_numbers(one.text.view(), kept_text.view());
    });
    if (found == all_.end()) {
        ++others_;
        return kOthers;
    }
    if (found == end) {
        *found = {};
        found->kind = kept_kind;
        found->weight = frame::weight_of(kind);
        ++size_;
    }
    ++found->times;
    found->text = kept_text;
    if (time.known()) {
        found->first = found->first.known() ? found->first : time;
        found->last = time;
    }
    return static_cast<std::size_t>(found - all_.begin());
}

}  // namespace gazeloop::latency

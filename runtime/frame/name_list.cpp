#include "runtime/frame/name_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gazeloop::frame {
namespace {

bool is_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
}

}  // namespace

Expected<NameList> NameList::parse(std::string_view text, std::size_t most) {
    NameList list;
    const auto refuse = [&](std::string_view why) {
        return std::unexpected(Error{ErrorKind::BadInput, fmt::format("'{}': {}", text, why)});
    };
    std::string_view rest = text;
    for (bool more = !text.empty(); more;) {
        const std::size_t blank = rest.find(' ');
        const std::string_view name = rest.substr(0, blank);
        more = blank != std::string_view::npos;
        rest.remove_prefix(more ? blank + 1 : rest.size());
        if (!is_word(name)) {
            return refuse(
                "names of lower case letters, digits and underscores are expected, "
                "separated by single blanks");
        }
        if (list.find(name)) {
            return refuse(fmt::format("'{}' is there twice", name));
        }
        if (list.size() == most) {
            return refuse(fmt::format("more than {} names", most));
        }
        list.names_.emplace_back(name);
    }
    return list;
}

std::string NameList::text() const { return fmt::format("{}", fmt::join(names_, " ")); }

}  // namespace gazeloop::frame

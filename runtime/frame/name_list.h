#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::frame {

/// Names of what a run has several of (passes, grids), in a fixed order. A name is one word of
/// lower case letters, digits and underscores. Fixed for a run; a session keeps them as text.
class NameList {
  public:
    NameList() = default;
    NameList(std::initializer_list<std::string_view> names) : names_(names.begin(), names.end()) {}

    /// Names separated by single blanks. Errors (BadInput): more than `most`, one twice, a name
    /// that is no word.
    static Expected<NameList> parse(std::string_view text, std::size_t most);
    [[nodiscard]] std::string text() const;

    [[nodiscard]] std::size_t size() const { return names_.size(); }
    [[nodiscard]] const std::string& operator[](std::size_t index) const { return names_[index]; }
    [[nodiscard]] std::span<const std::string> names() const { return names_; }

    /// The place of a name; none if it is not in the list.
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
        const auto at = std::ranges::find(names_, name);
        return at == names_.end() ? std::nullopt : std::optional<std::size_t>(at - names_.begin());
    }

    friend bool operator==(const NameList&, const NameList&) = default;

  private:
    std::vector<std::string> names_;
};

}  // namespace gazeloop::frame

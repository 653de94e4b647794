#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gazeloop::report {

/// A label and what there is to say of it, as the rows below a summary's table have them: at most
/// 100 columns wide, broken between words, all lines of the text indented by `indent` columns, of
/// which the label takes the first ones. A word that is wider stays whole. Ends with a newline.
[[nodiscard]] std::string wrapped_row(std::string_view label, std::string_view text,
                                      std::size_t indent = 9);

}  // namespace gazeloop::report

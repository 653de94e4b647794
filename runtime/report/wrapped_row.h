#pragma once

#include <string>
#include <string_view>

namespace gazeloop::report {

/// A label and what there is to say of it, as the rows below a summary's table have them: at most
/// 100 columns wide, broken between words, further lines indented below the text's begin. A word
/// that is wider stays whole. Ends with a newline.
[[nodiscard]] std::string wrapped_row(std::string_view label, std::string_view text);

}  // namespace gazeloop::report

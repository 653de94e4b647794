#include "runtime/compare/compared_files.h"

namespace gazeloop::compare {

ComparedFiles ComparedFiles::find(const std::filesystem::path& path) {
    ComparedFiles files;
    files.path_ = path;
    if (std::filesystem::is_directory(path)) {
        files.frames_ = value_or_throw(probe::FrameFiles::find(path));
    }
    return files;
}

}  // namespace gazeloop::compare

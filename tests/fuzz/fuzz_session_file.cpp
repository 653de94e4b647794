// Any bytes as a session file, played to its end: an error that names the file, or a session.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/session/playback.h"
#include "tests/support/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    static const tests::TemporaryFolder folder;
    const auto file = folder / "fuzz.session";
    for (const char* left : {"-wal", "-shm"}) {
        std::filesystem::remove(file.string() + left);
    }
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    const Expected<session::PlaybackEnd> end = session::play(file, {});
    if (!end && (end.error().kind != ErrorKind::BadInput ||
                 end.error().message.find(file.string()) == std::string::npos)) {
        std::abort();
    }
    return 0;
}

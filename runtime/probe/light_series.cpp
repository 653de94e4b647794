#include "runtime/probe/light_series.h"

#include <fmt/core.h>

#include <cerrno>
#include <system_error>

#include "runtime/error.h"

namespace gazeloop::probe {
namespace {

[[noreturn]] void fail(std::string_view what) {
    throw SetupError(ErrorKind::BadInput,
                     fmt::format("a temporary file {} ({}): make room in /tmp", what,
                                 std::generic_category().message(errno)));
}

}  // namespace

LightSeries::LightSeries() : file_(std::tmpfile()) {
    if (file_ == nullptr) {
        fail("cannot be made");
    }
}

void LightSeries::add(float lamp, float patch) {
    const Pair pair{lamp, patch};
    // What is read again is flushed and sought before (load).
    if (std::fwrite(pair.data(), sizeof(Pair), 1, file_.get()) != 1) {
        fail("cannot be written");
    }
    ++size_;
    loaded_ = SIZE_MAX;
}

double LightSeries::at(Light light, std::size_t frame) const {
    if (frame / kBlock != loaded_) {
        load(frame / kBlock);
    }
    return block_[frame % kBlock][static_cast<std::size_t>(light)];
}

void LightSeries::load(std::size_t block) const {
    const std::size_t begin = block * kBlock;
    const std::size_t pairs = std::min(kBlock, size_ - begin);
    if (std::fflush(file_.get()) != 0 ||
        std::fseek(file_.get(), static_cast<long>(begin * sizeof(Pair)), SEEK_SET) != 0 ||
        std::fread(block_.data(), sizeof(Pair), pairs, file_.get()) != pairs ||
        std::fseek(file_.get(), 0, SEEK_END) != 0) {
        fail("cannot be read");
    }
    loaded_ = block;
}

}  // namespace gazeloop::probe

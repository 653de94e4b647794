#include "drivers/trace/text/text_output.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace gazeloop::drivers {

class TextOutput::Gzip : public std::streambuf {
  public:
    explicit Gzip(const std::string& file) : file_(gzopen(file.c_str(), "wb6")) {
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }
    Gzip(const Gzip&) = delete;
    Gzip& operator=(const Gzip&) = delete;
    ~Gzip() override { (void)close(); }

    /// Whether all was written.
    bool close() {
        if (file_ == nullptr) {
            return false;
        }
        const bool flushed = flush();
        return gzclose(std::exchange(file_, nullptr)) == Z_OK && flushed;
    }

  protected:
    int_type overflow(int_type c) override {
        if (file_ == nullptr || !flush()) {
            return traits_type::eof();
        }
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            *pptr() = traits_type::to_char_type(c);
            pbump(1);
        }
        return traits_type::not_eof(c);
    }

  private:
    bool flush() {
        const auto size = static_cast<unsigned>(pptr() - pbase());
        const bool written = size == 0 || gzwrite(file_, pbase(), size) == static_cast<int>(size);
        setp(buffer_.data(), buffer_.data() + buffer_.size());
        return written;
    }

    gzFile file_;
    std::array<char, 65'536> buffer_{};
};

TextOutput::TextOutput(std::string file) : file_(std::move(file)) {
    std::error_code ignored;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file_, ignored);
    real_ = ignored ? file_ : real.string();
    const bool in_place = std::filesystem::exists(real_, ignored) &&
                          !std::filesystem::is_regular_file(real_, ignored);
    written_ = in_place ? "" : real_ + ".unfinished";
    const std::string& to = in_place ? real_ : written_;
    errno = 0;
    if (file_.ends_with(".gz")) {
        gzip_ = std::make_unique<Gzip>(to);
    } else {
        plain_.open(to, std::ios::binary | std::ios::trunc);
    }
    opened_errno_ = errno;
    stream_ = std::make_unique<std::ostream>(gzip_ ? static_cast<std::streambuf*>(gzip_.get())
                                                   : plain_.rdbuf());
}

TextOutput::~TextOutput() {
    if (!written_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(written_, ignored);
    }
}

Expected<void> TextOutput::close() {
    errno = opened_errno_;
    bool written = stream_->good();
    if (gzip_) {
        written = gzip_->close() && written;
    } else {
        plain_.close();
        written = !plain_.fail() && written;
    }
    if (written && !written_.empty()) {
        written = std::rename(written_.c_str(), real_.c_str()) == 0;
    }
    if (written) {
        written_.clear();
        return {};
    }
    return std::unexpected(
        Error{ErrorKind::BadInput,
              fmt::format("{}: cannot be written ({})", file_,
                          errno != 0 ? std::generic_category().message(errno) : "unknown why")});
}

}  // namespace gazeloop::drivers

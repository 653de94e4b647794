#include "drivers/trace/text/text_output.h"

#include <zlib.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "runtime/files/output_file.h"

namespace gazeloop::drivers {

/// Gathers text, compresses it if that is asked for, and writes it. The first error is kept.
class TextOutput::Pieces : public std::streambuf {
  public:
    explicit Pieces(const std::string& file) {
        if (auto output = files::OutputFile::open(file)) {
            output_.emplace(std::move(*output));
        } else {
            result_ = std::unexpected(std::move(output.error()));
        }
        constexpr int kGzip = 16;
        if (file.ends_with(".gz") && deflateInit2(&deflate_, 6, Z_DEFLATED, MAX_WBITS + kGzip,
                                                  MAX_MEM_LEVEL - 1, Z_DEFAULT_STRATEGY) == Z_OK) {
            compressed_.emplace();
        }
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }
    Pieces(const Pieces&) = delete;
    Pieces& operator=(const Pieces&) = delete;
    ~Pieces() override {
        if (compressed_) {
            deflateEnd(&deflate_);
        }
    }

    Expected<void> close() {
        flush(true);
        if (result_) {
            result_ = output_->close();
        }
        return std::move(result_);
    }

  protected:
    int_type overflow(int_type c) override {
        if (!flush(false)) {
            return traits_type::eof();
        }
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            *pptr() = traits_type::to_char_type(c);
            pbump(1);
        }
        return traits_type::not_eof(c);
    }

  private:
    static constexpr std::size_t kPiece = 65'536;

    /// Whether all was written until now.
    bool flush(bool end) {
        const std::string_view text(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        setp(buffer_.data(), buffer_.data() + buffer_.size());
        if (!compressed_) {
            write(text);
            return result_.has_value();
        }
        deflate_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
        deflate_.avail_in = static_cast<uInt>(text.size());
        do {
            deflate_.next_out = reinterpret_cast<Bytef*>(compressed_->data());
            deflate_.avail_out = static_cast<uInt>(kPiece);
            ::deflate(&deflate_, end ? Z_FINISH : Z_NO_FLUSH);
            write({compressed_->data(), kPiece - deflate_.avail_out});
        } while (deflate_.avail_out == 0);
        return result_.has_value();
    }

    void write(std::string_view bytes) {
        if (result_ && !bytes.empty()) {
            result_ = output_->write(bytes);
        }
    }

    std::optional<files::OutputFile> output_;  ///< none: it could not be opened
    Expected<void> result_;
    z_stream deflate_{};
    std::array<char, kPiece> buffer_{};
    std::optional<std::array<char, kPiece>> compressed_;  ///< none: plain
};

TextOutput::TextOutput(const std::string& file)
    : pieces_(std::make_unique<Pieces>(file)), stream_(pieces_.get()) {}

TextOutput::~TextOutput() = default;

Expected<void> TextOutput::close() { return pieces_->close(); }

}  // namespace gazeloop::drivers

#include "drivers/trace/text/byte_stream.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

namespace gazeloop::drivers {

/// zlib's state, which must stay where it is.
class GzipMembers {
  public:
    GzipMembers() {
        constexpr int kLargestWindow = 15;
        constexpr int kGzip = 16;
        if (inflateInit2(&state_, kLargestWindow + kGzip) != Z_OK) {
            throw std::bad_alloc();
        }
    }
    GzipMembers(const GzipMembers&) = delete;
    GzipMembers& operator=(const GzipMembers&) = delete;
    ~GzipMembers() { inflateEnd(&state_); }

    /// Whether a member has ended and no other begun.
    [[nodiscard]] bool between_members() const { return between_members_; }

    /// Takes from the front of `from` and fills the front of `to`: how many bytes. Errors, in
    /// zlib's words.
    std::expected<std::size_t, std::string> inflate_some(std::span<char>& from,
                                                         std::span<char> to) {
        if (between_members_) {
            inflateReset(&state_);
            between_members_ = false;
        }
        state_.next_in = reinterpret_cast<Bytef*>(from.data());
        state_.avail_in = static_cast<uInt>(from.size());
        state_.next_out = reinterpret_cast<Bytef*>(to.data());
        state_.avail_out = static_cast<uInt>(to.size());
        const int result = inflate(&state_, Z_NO_FLUSH);
        from = from.last(state_.avail_in);
        if (result == Z_STREAM_END) {
            between_members_ = true;
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            return std::unexpected(state_.msg != nullptr ? state_.msg : zError(result));
        }
        return to.size() - state_.avail_out;
    }

  private:
    z_stream state_{};
    bool between_members_ = false;
};

namespace {

constexpr std::size_t kPiece = 65'536;
constexpr char kFirstOfGzip = '\x1f';
constexpr char kSecondOfGzip = '\x8b';

std::unexpected<std::string> damaged(std::string_view why) {
    return std::unexpected(
        fmt::format("the gzip data are damaged ({}): copy or download the file again", why));
}

}  // namespace

ByteStream::ByteStream(std::istream& in) : in_(&in), raw_(kPiece) {}
ByteStream::ByteStream(ByteStream&&) noexcept = default;
ByteStream& ByteStream::operator=(ByteStream&&) noexcept = default;
ByteStream::~ByteStream() = default;

std::expected<bool, std::string> ByteStream::refill() {
    in_->read(raw_.data(), static_cast<std::streamsize>(raw_.size()));
    if (in_->bad() || (in_->fail() && !in_->eof())) {
        return std::unexpected("cannot be read: check the disk, or copy the file again");
    }
    unused_ = std::span{raw_}.first(static_cast<std::size_t>(in_->gcount()));
    return !unused_.empty();
}

std::expected<std::size_t, std::string> ByteStream::read(std::span<char> to) {
    if (unused_.empty()) {
        if (const auto more = refill(); !more) {
            return std::unexpected(more.error());
        }
    }
    if (!started_) {
        started_ = true;
        if (unused_.size() >= 2 && unused_[0] == kFirstOfGzip && unused_[1] == kSecondOfGzip) {
            gzip_ = std::make_unique<GzipMembers>();
        }
    }
    if (gzip_) {
        return decompressed(to);
    }
    const std::size_t taken = std::min(to.size(), unused_.size());
    std::copy_n(unused_.begin(), taken, to.begin());
    unused_ = unused_.subspan(taken);
    return taken;
}

std::optional<std::uint64_t> ByteStream::bytes_left() {
    if (gzip_ || !in_->good()) {
        return std::nullopt;
    }
    const std::streamoff now = in_->tellg();
    const std::streamoff end = now < 0 ? now : std::streamoff{in_->seekg(0, std::ios::end).tellg()};
    in_->clear();
    if (now < 0 || end < now) {
        return std::nullopt;
    }
    in_->seekg(now);
    return unused_.size() + static_cast<std::uint64_t>(end - now);
}

std::expected<std::size_t, std::string> ByteStream::decompressed(std::span<char> to) {
    while (true) {
        if (unused_.empty()) {
            const auto more = refill();
            if (!more) {
                return std::unexpected(more.error());
            }
            if (!*more) {
                if (gzip_->between_members()) {
                    return 0;
                }
                return std::unexpected(
                    "the gzip data end early, the file was cut: copy or download it again");
            }
        }
        if (gzip_->between_members() && unused_.front() != kFirstOfGzip) {
            return std::unexpected(
                "something else follows the end of the gzip data: decompress the file with gzip "
                "-dc FILE > OTHER.csv, look at it, and read that");
        }
        const auto some = gzip_->inflate_some(unused_, to);
        if (!some) {
            return damaged(some.error());
        }
        if (*some > 0) {
            return *some;
        }
    }
}

}  // namespace gazeloop::drivers

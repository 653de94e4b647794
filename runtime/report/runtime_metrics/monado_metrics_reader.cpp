#include "runtime/report/runtime_metrics/monado_metrics_reader.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <protozero/varint.hpp>
#include <utility>

#include "runtime/open_for_reading.h"

namespace gazeloop::report {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::string_view kRemedy =
    "give the file that XRT_METRICS_FILE named when monado-service was started";

std::unexpected<Error> error(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

}  // namespace

MonadoMetricsReader::MonadoMetricsReader(std::unique_ptr<std::istream> in, std::string name)
    : in_(std::move(in)), name_(std::move(name)) {
    record_.reserve(kLongestRecord);
}

Expected<MonadoMetricsReader> MonadoMetricsReader::open(const std::filesystem::path& file) {
    std::error_code none;
    const auto kind = std::filesystem::status(file, none).type();
    if (kind != std::filesystem::file_type::regular &&
        kind != std::filesystem::file_type::not_found &&
        kind != std::filesystem::file_type::directory) {
        return error(fmt::format("{}: no file of bytes, which alone has an end: {}", file.string(),
                                 kRemedy));
    }
    auto in = open_for_reading(file);
    if (!in) {
        return error(fmt::format("{}: {}: {}", file.string(), in.error(), kRemedy));
    }
    return open(std::make_unique<std::ifstream>(std::move(*in)), file.string());
}

Expected<MonadoMetricsReader> MonadoMetricsReader::open(std::unique_ptr<std::istream> in,
                                                        std::string name) {
    MonadoMetricsReader reader(std::move(in), std::move(name));
    if (reader.in_->peek() == std::istream::traits_type::eof()) {
        return error(fmt::format(
            "{}: empty. Monado writes to it as it ends, or at once with XRT_METRICS_EARLY_FLUSH=1",
            reader.name_));
    }
    const std::optional<MonadoRecord> first = reader.next();
    const auto* const version = first ? std::get_if<MonadoVersion>(&*first) : nullptr;
    if (version == nullptr || reader.counts_.damaged > 0) {
        return error(
            fmt::format("{}: byte 0: no metrics file of Monado, which begins with its version: {}",
                        reader.name_, kRemedy));
    }
    if (version->major != kVersion) {
        return error(fmt::format(
            "{}: byte 0: its version is {}.{}, and {}.x is read here: record it with Monado 25",
            reader.name_, version->major, version->minor, kVersion));
    }
    reader.version_ = *version;
    return reader;
}

std::optional<MonadoRecord> MonadoMetricsReader::next() {
    while (read_bytes()) {
        if (auto record = monado_record(record_)) {
            ++counts_.records;
            counts_.unknown += std::holds_alternative<std::monostate>(*record) ? 1 : 0;
            return record;
        }
        counts_.first_damaged_at = counts_.damaged == 0 ? begin_ : counts_.first_damaged_at;
        ++counts_.damaged;
    }
    return std::nullopt;
}

bool MonadoMetricsReader::read_bytes() {
    if (counts_.cut_at || counts_.lost_at) {
        return false;
    }
    begin_ = at_;
    const std::optional<std::uint64_t> length = read_length();
    if (!length) {
        return false;
    }
    record_.resize(static_cast<std::size_t>(*length));
    const std::streamsize got =
        in_->rdbuf()->sgetn(record_.data(), static_cast<std::streamsize>(*length));
    at_ += static_cast<std::uint64_t>(got);
    if (static_cast<std::uint64_t>(got) < *length) {
        counts_.cut_at = begin_;
        return false;
    }
    return true;
}

std::optional<std::uint64_t> MonadoMetricsReader::read_length() {
    constexpr unsigned kMore = 0x80;
    std::array<char, protozero::max_varint_length> bytes{};
    for (std::size_t size = 0; size < bytes.size();) {
        const auto byte = in_->rdbuf()->sbumpc();
        if (byte == std::istream::traits_type::eof()) {
            if (size > 0) {
                counts_.cut_at = begin_;
            }
            return std::nullopt;
        }
        ++at_;
        bytes[size++] = std::istream::traits_type::to_char_type(byte);
        if ((static_cast<unsigned>(byte) & kMore) == 0) {
            const char* at = bytes.data();
            const std::uint64_t length = protozero::decode_varint(&at, bytes.data() + size);
            if (length <= kLongestRecord) {
                return length;
            }
            break;
        }
    }
    counts_.lost_at = begin_;
    return std::nullopt;
}

}  // namespace gazeloop::report

#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "runtime/error.h"
#include "runtime/report/runtime_metrics/monado_record.h"

namespace gazeloop::report {

/// What became of a file's records.
struct MonadoFileCounts {
    std::uint64_t records = 0;           ///< read whole, of any kind
    std::uint64_t unknown = 0;           ///< of them, of no kind that is used here
    std::uint64_t damaged = 0;           ///< no messages, and left out
    std::uint64_t first_damaged_at = 0;  ///< byte of the file; meaningful where there are some
    std::optional<std::uint64_t>
        cut_at{};  ///< the byte where a record begins that the file lacks an end of
    std::optional<std::uint64_t>
        lost_at{};  ///< from this byte on nothing is read: no record is so long
};

/// Reads a metrics file of Monado record by record, in fixed memory. A record lies behind its
/// length as a varint.
class MonadoMetricsReader {
  public:
    /// Monado's records are below 200 bytes.
    static constexpr std::uint64_t kLongestRecord = 65'536;

    /// Errors (BadInput, with file and remedy): a file that cannot be opened, is no file of bytes,
    /// is empty, does not begin with the version of such a file, or has another one than 1.x.
    static Expected<MonadoMetricsReader> open(const std::filesystem::path& file);
    /// The same of a stream; `name` stands in messages.
    static Expected<MonadoMetricsReader> open(std::unique_ptr<std::istream> in, std::string name);

    /// The next one that is a message; none at the end, or where the file cannot be read on.
    [[nodiscard]] std::optional<MonadoRecord> next();

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const MonadoVersion& version() const { return version_; }
    /// Of what was read so far.
    [[nodiscard]] const MonadoFileCounts& counts() const { return counts_; }

  private:
    MonadoMetricsReader(std::unique_ptr<std::istream> in, std::string name);

    /// The bytes of the next record, in record_; false at the end.
    [[nodiscard]] bool read_bytes();
    /// The length in front of the next record.
    [[nodiscard]] std::optional<std::uint64_t> read_length();

    std::unique_ptr<std::istream> in_;
    std::string name_;
    MonadoVersion version_;
    MonadoFileCounts counts_;
    std::uint64_t at_ = 0;     ///< bytes that were taken from the file
    std::uint64_t begin_ = 0;  ///< where the record began
    std::string record_;
};

}  // namespace gazeloop::report

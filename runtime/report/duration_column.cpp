#include "runtime/report/duration_column.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/latency/nearest_rank.h"

namespace gazeloop::report {
namespace {

constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::min();

}  // namespace

std::string_view unit_suffix(Unit unit) {
    switch (unit) {
        case Unit::Nanoseconds:
            return "_ms";
        case Unit::Microdegrees:
            return "_degrees";
        case Unit::Count:
            break;
    }
    return "";
}

void NumberColumn::add(std::optional<std::int64_t> number) {
    if (size_ % kBlockRows == 0) {
        blocks_.emplace_back();
    }
    blocks_.back().add(number);
    ++size_;
}

std::optional<std::int64_t> NumberColumn::at(std::size_t row) const {
    return blocks_[row / kBlockRows].at(row % kBlockRows);
}

void NumberColumn::Block::add(std::optional<std::int64_t> number) {
    if (rows_ == 0) {
        first_ = number;
    }
    if (form_ == Form::Alike && number != first_) {
        base_ = first_ ? *first_ : *number;
        spread();
    }
    const std::optional<std::int32_t> difference =
        form_ == Form::Near ? near(number) : std::nullopt;
    if (form_ == Form::Near && !difference) {
        widen();
    }
    if (form_ == Form::Near) {
        near_.push_back(*difference);
    } else if (form_ == Form::Any) {
        any_.push_back(number.value_or(0));
        known_.push_back(number.has_value());
    }
    ++rows_;
}

std::optional<std::int64_t> NumberColumn::Block::at(std::size_t row) const {
    switch (form_) {
        case Form::Alike:
            return first_;
        case Form::Near:
            // Between numbers of 64 bits, which near() has added up the other way.
            return near_[row] == kUnknown ? std::nullopt : std::optional(base_ + near_[row]);
        case Form::Any:
            break;
    }
    return known_[row] ? std::optional(any_[row]) : std::nullopt;
}

/// As it is kept in near_; none where it does not fit.
std::optional<std::int32_t> NumberColumn::Block::near(std::optional<std::int64_t> number) const {
    std::int64_t difference = 0;
    if (!number) {
        return kUnknown;
    }
    if (__builtin_sub_overflow(*number, base_, &difference) || difference <= kUnknown ||
        difference > std::numeric_limits<std::int32_t>::max()) {
        return std::nullopt;
    }
    return static_cast<std::int32_t>(difference);
}

void NumberColumn::Block::spread() {
    form_ = Form::Near;
    near_.reserve(kBlockRows);
    near_.assign(rows_, first_ ? 0 : kUnknown);
}

void NumberColumn::Block::widen() {
    any_.reserve(kBlockRows);
    known_.reserve(kBlockRows);
    for (std::size_t row = 0; row < rows_; ++row) {
        const std::optional<std::int64_t> number = at(row);
        any_.push_back(number.value_or(0));
        known_.push_back(number.has_value());
    }
    form_ = Form::Any;
    near_ = {};
}

DurationColumn::DurationColumn(std::string key, std::string label, Unit unit)
    : key_(std::move(key)), label_(std::move(label)), unit_(unit) {}

void DurationColumn::add(const time::Span& span) {
    ++frames_by_kind_[static_cast<std::size_t>(span.kind)];
    if (!span.known()) {
        numbers_.add(std::nullopt);
        return;
    }
    numbers_.add(span.ns);
    least_ = known_ == 0 ? span.ns : std::min(least_, span.ns);
    greatest_ = known_ == 0 ? span.ns : std::max(greatest_, span.ns);
    sum_ += span.ns;
    negative_ += span.ns < 0 ? 1 : 0;
    ++known_;
}

void DurationColumn::forget() {
    DurationColumn unknown(std::move(key_), std::move(label_), unit_);
    for (const std::uint64_t frames : frames_by_kind_) {
        unknown.frames_by_kind_[static_cast<std::size_t>(time::StampKind::Unknown)] += frames;
    }
    for (std::size_t row = 0; row < size(); ++row) {
        unknown.skip();
    }
    *this = std::move(unknown);
}

std::optional<std::int64_t> DurationColumn::least() const {
    return known_ == 0 ? std::nullopt : std::optional(least_);
}

std::optional<std::int64_t> DurationColumn::greatest() const {
    return known_ == 0 ? std::nullopt : std::optional(greatest_);
}

std::optional<double> DurationColumn::mean() const {
    return known_ == 0 ? std::nullopt
                       : std::optional(static_cast<double>(sum_) / static_cast<double>(known_));
}

std::vector<std::optional<std::int64_t>> DurationColumn::percentiles(
    std::span<const double> percents) const {
    std::vector<std::int64_t> numbers;
    numbers.reserve(known_);
    for (std::size_t row = 0; row < size(); ++row) {
        if (const auto number = at(row)) {
            numbers.push_back(*number);
        }
    }
    std::vector<std::optional<std::int64_t>> result;
    result.reserve(percents.size());
    for (const double percent : percents) {
        const auto rank = latency::nearest_rank(percent, known_);
        if (!rank) {
            result.emplace_back();
            continue;
        }
        const auto at_rank = numbers.begin() + static_cast<std::ptrdiff_t>(*rank - 1);
        std::nth_element(numbers.begin(), at_rank, numbers.end());
        result.emplace_back(*at_rank);
    }
    return result;
}

std::vector<Bin> DurationColumn::bins(std::size_t first, std::size_t end, std::size_t count) const {
    const std::size_t rows = end - first;
    count = std::min(count, rows);
    std::vector<Bin> bins;
    bins.reserve(count);
    for (std::size_t place = 0; place < count; ++place) {
        // rows * place would not fit where both are beyond 2^32.
        const auto edge = [&](std::size_t at) {
            return first +
                   static_cast<std::size_t>(static_cast<unsigned __int128>(rows) * at / count);
        };
        Bin& bin = bins.emplace_back(Bin{.first = edge(place), .end = edge(place + 1)});
        __int128 sum = 0;
        for (std::size_t row = bin.first; row < bin.end; ++row) {
            if (const auto number = at(row)) {
                bin.least = bin.known == 0 ? *number : std::min(bin.least, *number);
                bin.greatest = bin.known == 0 ? *number : std::max(bin.greatest, *number);
                sum += *number;
                ++bin.known;
            }
        }
        bin.mean = bin.known == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(bin.known);
    }
    return bins;
}

}  // namespace gazeloop::report

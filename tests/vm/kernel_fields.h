#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/hid/report_descriptor.h"

namespace gazeloop::tests {

/// What Linux says of a field in /sys/kernel/debug/hid/DEVICE/rdesc, in the same words on both
/// sides, so that two lists can be compared and a difference read.
using FieldText = std::string;

/// The fields that the kernel lists there, by kind and report id, then in order.
[[nodiscard]] std::vector<FieldText> fields_of_kernel(const std::string& rdesc);

/// Our parser's fields as the kernel would list them. It leaves out those without a usage
/// (padding), keeps 32 bits of each range, and omits what says nothing: ranges whose ends are the
/// same, no unit, no exponent.
[[nodiscard]] std::vector<FieldText> fields_of(const drivers::hid::ReportDescriptor& descriptor);

}  // namespace gazeloop::tests

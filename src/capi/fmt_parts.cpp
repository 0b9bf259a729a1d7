// SPDX-License-Identifier: Apache-2.0
// The compiled part of fmt, which distributions have as a shared library only, so that nothing but
// the C library is needed where the C interface runs.
#include <fmt/format-inl.h>

FMT_BEGIN_NAMESPACE
namespace detail {

template dragonbox::decimal_fp<float> dragonbox::to_decimal(float x) noexcept;
template dragonbox::decimal_fp<double> dragonbox::to_decimal(double x) noexcept;
template thousands_sep_result<char> thousands_sep_impl(locale_ref loc);
template char decimal_point_impl(locale_ref loc);

}  // namespace detail
FMT_END_NAMESPACE

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid::cad {

/// Runs the command named by $OBVID_CAD_BUILDER, which builds the helper when it is first needed;
/// false where none is named or it fails. The launcher of a source folder names one. Its words go
/// to standard error, because standard output may be the result.
[[nodiscard]] bool build_helper();

}  // namespace obvid::cad

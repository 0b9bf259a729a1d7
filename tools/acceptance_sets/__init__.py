# SPDX-License-Identifier: Apache-2.0
"""Parts of tools/acceptance: one file per kind of data, shared running, judging and printing."""

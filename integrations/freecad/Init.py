# SPDX-License-Identifier: Apache-2.0
# Run by every start of FreeCAD, with and without a window. Features are loaded by their documents.

// SPDX-License-Identifier: Apache-2.0
// The long texts of `obvid explain`. They speak to the user who met the error, not to programmers.
#include <array>

#include "obvid/core/error.h"

namespace obvid {
namespace {

constexpr std::array kTexts{
    ErrorText{ErrorCode::kInternal, "Internal error",
              "The program met a state that its authors held to be impossible. Your data are not "
              "to blame.",
              "Report it together with the input file and the command, so that it can be repeated "
              "and mended."},
    ErrorText{ErrorCode::kWriteFailed, "Output could not be written",
              "A file could not be created or written whole. Files are written beside their place "
              "and then renamed, so what stood there before is untouched.",
              "Check that the folder exists, that you may write to it and that the disk has room."},
    ErrorText{
        ErrorCode::kCancelled, "Cancelled",
        "The work was stopped before its end by whoever asked for it. There is no result, and "
        "no file was written.",
        "Ask again if it was a mistake."},
    ErrorText{ErrorCode::kUsage, "Wrong use of the command line",
              "The command, an option or the number of arguments is not one that this program "
              "knows.",
              "See `obvid --help` or `obvid COMMAND --help` for what is possible."},
    ErrorText{ErrorCode::kUnknownFormat, "Unknown output format",
              "The format of an output file is determined by its file extension, and this one "
              "stands for no format that the program writes.",
              "Use one of the extensions that the error lists, for example .json or .svg."},
    ErrorText{ErrorCode::kBadOption, "Option not possible",
              "An option has a value outside its range, contradicts another one, or asks for "
              "something that this version cannot do. It is refused instead of ignored, because a "
              "contour formed without it would be a wrong answer.",
              "Correct or leave out the option; `obvid COMMAND --help` shows units and ranges."},
    ErrorText{ErrorCode::kCannotOpen, "Input could not be opened",
              "The input file does not exist or may not be read.",
              "Check the path and the permissions. A single - reads standard input."},
    ErrorText{ErrorCode::kBadNumber, "Not a number",
              "A place where a coordinate was expected holds something else. The error names file, "
              "line and column.",
              "Correct that line. Comments start with #, !, // or ; and one header line is allowed "
              "before the numbers; a decimal comma needs a separator other than the comma."},
    ErrorText{ErrorCode::kNotFinite, "NaN or infinity in the input",
              "A coordinate is not a finite number, so the point lies nowhere. Such values usually "
              "come from a failed measurement or a division by zero in the program that wrote the "
              "file.",
              "Remove the point or repair its coordinates."},
    ErrorText{ErrorCode::kTooFewPoints, "Too few points",
              "A contour needs at least three distinct points; consecutive points with equal "
              "coordinates count once.",
              "Give more points, and check that the right columns and the right file were read."},
    ErrorText{ErrorCode::kTooFewColumns, "Too few columns",
              "A line holds a single number, but a point needs at least x and y.",
              "Put both coordinates on one line, separated by blanks, tabs, commas or semicolons."},
    ErrorText{ErrorCode::kNotText, "Not a text file",
              "The input holds bytes that do not occur in text. It is probably a binary drawing, a "
              "spreadsheet or an archive.",
              "Export the points as text (x and y per line) and read that file."},
    ErrorText{ErrorCode::kBadCount, "A stated count does not match",
              "The file says how many points it holds, and it holds a different number. It may be "
              "cut off, or two files may have been joined.",
              "Get the file again, or correct the count if you know the points to be complete."},
    ErrorText{
        ErrorCode::kBadJson, "Contour file malformed",
        "The file is not valid JSON, or a field is missing, has the wrong type or contradicts "
        "another field. The error names line and column, or the path of the field.",
        "Form the contour again with `obvid fit`, or correct the named field."},
    ErrorText{ErrorCode::kSizeOutOfRange, "Size out of range",
              "The coordinates are so large or so small that their squares and ratios leave the "
              "range of double precision numbers.",
              "Change the unit, for example to millimetres, so that the drawing's size is a usual "
              "number."},
    ErrorText{ErrorCode::kUnsupported, "Kind of file or content not supported",
              "The file was recognised, but its kind, its version or one of its parts cannot be "
              "read by this version of the program.",
              "Export the points as text, or update the program if a newer one wrote the file."},
    ErrorText{ErrorCode::kNothingThere, "Nothing there",
              "The file, contour or model was read, and holds nothing of the kind that was asked "
              "for: no pieces, no curves, no patches, no triangles.",
              "Check that the right file, layer or part was given."},
    ErrorText{ErrorCode::kTooFewCurves, "Too few curves or sections",
              "A surface needs more curves: a skin two sections, a net two curves of each family, "
              "a patch between four borders all four.",
              "Give the missing curves, and check that all files were read as they were meant."},
    ErrorText{ErrorCode::kOutOfOrder, "Neighbours coincide or are out of order",
              "Nodes, parameters or knots must ascend, and neighbouring points, rows or sections "
              "must differ. Where they do not, nothing can be laid between them.",
              "Sort them, and keep one of those that coincide."},
    ErrorText{ErrorCode::kDamaged, "The file is not what it says",
              "The file is not of the kind that its name or its head says, or it is cut off or "
              "damaged, so that the reader of that kind gives up.",
              "Export it again, or get it again from where it came."},
    ErrorText{
        ErrorCode::kNoSpiral, "No contour with monotone curvature was found here",
        "No curve was found that joins the named points and whose curvature changes in the "
        "direction that the data ask for, or the carrier has no such curve: conics and "
        "parabolas have no inflection, and no monotone parabolas are nearly an arc. That none was "
        "found is no proof that none exists.",
        "Check the named points for a typing or measuring error; the error line says within "
        "which tolerance there is a contour, where one was found. Otherwise add points where "
        "the shape turns quickly, let points move (`--noise`), or take `--carrier spiral`."},
    ErrorText{ErrorCode::kChordReversal, "The series turns back on itself",
              "Two neighbouring chords point in nearly opposite directions. The points are too few "
              "there to say which way the contour turns.",
              "Put more points around the named one, or split the series at a corner. Neighbouring "
              "chords should turn by less than 90 degrees."},
    ErrorText{
        ErrorCode::kFixedDataContradict, "Fixed headings or curvatures contradict the points",
        "Contours run through the points, but with as few vertices as these show none also has "
        "the headings, radii or curvatures that were fixed.",
        "Free the named values, take one from the range that the error line names, or type its "
        "`--noise`: within it points may move, and there may be more vertices."},
    ErrorText{
        ErrorCode::kNoRoomForTransition, "No room for a curvature-continuous transition",
        "Four or more points lie exactly on one line or circle, and the points beside them are "
        "so close to it that the curvature would have to jump at its end.",
        "Move or leave out the named points, or one point at the end of the straight or "
        "circular stretch."},
    ErrorText{ErrorCode::kRoundingDecides, "Rounding of the coordinates decides",
              "The points are so close together, compared with the size of their coordinates, that "
              "the last digit of the numbers determines the curvature. Another rounding of the "
              "same shape would give another answer.",
              "Move the origin to the part, give more digits, or leave out points that are too "
              "close to each other."},
    ErrorText{
        ErrorCode::kCarrierCannotKeep, "This carrier cannot keep what was given",
        "The contour could be formed with spirals, but the carrier that was asked for has too "
        "little freedom to have the heading, radius or corner given at the named point, or to lead "
        "from it to the next one as the spirals do. Nothing was written.",
        "Use `--carrier spiral`, which keeps everything that a contour can have, or give less at "
        "this point."},
    ErrorText{
        ErrorCode::kWanders, "The contour would wander between two points",
        "Between two neighbouring points the contour would leave the directions of all circles "
        "through three points beside it by more than these differ among each other and 45 "
        "degrees: a swing or a loop that the points do not ask for. Its curvature may well be "
        "monotone; that alone makes no sensible shape.",
        "Look at the named points. If the contour turns at once there, mark corners "
        "(--corner-at); if a straight or round part is given by its ends only, put points on "
        "it; or allow the points to move (--noise)."},
    ErrorText{
        ErrorCode::kSurfaceFolds, "The surface would fold back on itself",
        "At the distance that was asked for, the offset passes a centre of curvature of the "
        "surface and turns inside out there. The error names the places and the largest distance "
        "on this side at which it does not. Of scattered points: neighbours in the plane lie at "
        "such "
        "different heights that a surface over this plane would have to be a wall.",
        "Take a smaller distance, or smooth the surface where it bends most. For points give "
        "another "
        "direction of the heights, leave outliers out, or raise the tolerance above the noise."},
    ErrorText{
        ErrorCode::kToolTooLarge, "The tool does not fit",
        "At half its diameter from the outline the tool would have to turn in a hollow that is "
        "narrower than itself, or would cut into the other side of a slot or into another "
        "outline. The error names the place; a program that leaves it out would not cut what is "
        "drawn.",
        "Take a smaller cutter (`--diameter`), cut on the other side or along the outline "
        "(`--side`), or leave it out of the drawing."},
    ErrorText{
        ErrorCode::kNotProved, "Formed, but not proved",
        "A contour was formed, but the proof of one of its properties did not succeed. It may "
        "still be good; the program does not claim it.",
        "See the reason in the report. Report the data if you believe the contour to be "
        "right."},
    ErrorText{ErrorCode::kToleranceNotReached, "Tolerance not reached",
              "The region in which the contour is known to lie could not be made as narrow as the "
              "tolerance asks for, usually because the tolerance is near the rounding of the "
              "coordinates. Or a carrier could not follow within it, or the digits of a file "
              "format do not keep it; then no file was written.",
              "Use a larger `--tolerance` (of a file: `--output-tolerance`), or another carrier "
              "or format."},
    ErrorText{ErrorCode::kFalseClaim, "The contour file claims something false",
              "A figure or a verdict in the file does not agree with what its curve really is. The "
              "file was changed after it was written, or written by a faulty program.",
              "Do not use the file. Form the contour again from its points with `obvid fit`."},
    ErrorText{ErrorCode::kNotAllCut, "Not all of the drawing is in the program",
              "The program for the machine was made and written, but entities of the drawing that "
              "are curves could not be read; warnings name the first of each kind and why. What "
              "they outline is not cut.",
              "Mend or explode these entities in the CAD system, or choose the curves to cut with "
              "`--curve`."},
};

}  // namespace

std::span<const ErrorText> error_texts() { return kTexts; }

}  // namespace obvid

// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/status.h>
#include <pcl6d/io/text.h>
#include <pcl6d/scanner/calibrate_stereo.h>
#include <pcl6d/scanner/camera_calibration.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/image_files.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Inner corners of a board in one word: 9x6. */
struct BoardSize {
  int cols = Chessboard().cols, rows = Chessboard().rows;
};

std::istream&
operator>>(std::istream& stream, BoardSize& size)
{
  char by = 0;
  stream >> size.cols >> by >> size.rows;
  if (by != 'x')
    stream.setstate(std::ios::failbit);
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const BoardSize& size)
{
  return stream << size.cols << 'x' << size.rows;
}

struct CalibrateSettings {
  std::string input, right, output;
  BoardSize size;
  Chessboard board;
  CalibrationOptions options;
};

bool
parse(const std::vector<std::string>& arguments, CalibrateSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert +
                    R"( calibrate PICTURES -o CAMERA.yml [options]
Calibrates a camera from the pictures of a chessboard in a folder, or two cameras, if
the folder holds left* and right* pictures or --right names a second folder: pairs in
their order. Writes a camera file (M1 D1, of two also M2 D2 R T; .yml, .xml or .json),
which `depth` and `stereo` take. At least 3 pictures must show the whole board, which
is to be turned to many sides and to reach the borders of the image.
)");
  table.positional("PICTURES", &s.input);
  table.group("Pictures");
  table.add("right DIR", &s.right).help("folder with the pictures of the right camera");
  table.group("Board");
  table.add("board COLSxROWS", &s.size).help("inner corners in a row and in a column");
  table.add("square M", &s.board.square).help("[m] side of a square");
  table.group("Distortion");
  table.add("no-tangential", &s.options.tangential).help("p1 and p2 are zero");
  table.add("k3", &s.options.third).help("fit k3, too: needs corners near the border");
  table.group("Output");
  table.add("output,o FILE", &s.output).required().help("camera file");
  if (!table.parse(arguments))
    return false;
  s.board.cols = s.size.cols;
  s.board.rows = s.size.rows;
  table.check([&] { s.board.validate(); }, {{"rows", "board"}, {"cols", "board"}});
  refuseInputs(s.output, {s.input, s.right});
  return true;
}

/** The pictures of one camera, and the board's corners in the pictures. */
struct Views {
  std::vector<fs::path> files;
  std::vector<std::optional<CalibrationView>> found; ///< one entry per file
  cv::Size size;                                     ///< [px]
};

Views
findBoards(const std::vector<fs::path>& files, const Chessboard& board)
{
  Views views;
  views.files = files;
  for (const auto& file : files) {
    const cv::Mat image = readGrayImage(file);
    if (views.found.empty())
      views.size = image.size();
    if (image.size() != views.size)
      throw IoFailed(file.string() + ": has " + std::to_string(image.cols) + " x " +
                     std::to_string(image.rows) + " pixels, but " +
                     files.front().string() + " has " +
                     std::to_string(views.size.width) + " x " +
                     std::to_string(views.size.height));
    views.found.push_back(findChessboard(image, board));
  }
  return views;
}

/** \throws ComputeFailed fewer than three pictures (or pairs) show the board */
void
requireBoards(const CalibrateSettings& s, std::size_t with_board, std::size_t of)
{
  constexpr std::size_t kFewest = 3;
  if (with_board < kFewest)
    throw ComputeFailed(s.input + ": " + std::to_string(with_board) + " of " +
                        std::to_string(of) +
                        (s.right.empty() ? " pictures" : " pairs") +
                        " show the whole board, but at least 3 are needed; --board " +
                        std::to_string(s.board.cols) + "x" +
                        std::to_string(s.board.rows) + " counts inner corners");
}

void
printMissing(const Views& views)
{
  for (std::size_t i = 0; i < views.files.size(); ++i)
    if (!views.found[i])
      std::printf("no board in %s\n", views.files[i].string().c_str());
}

void
requireAnswer(const CalibrateSettings& s, Status status)
{
  if (status != Status::kOk)
    throw ComputeFailed(s.input + ": the camera does not follow from these pictures (" +
                        toString(status) + "); turn the board to more sides");
}

void
printCamera(const char* name, const CameraIntrinsics& lens, double rms)
{
  std::printf("%s: fx %.6g fy %.6g cx %.6g cy %.6g px, k1 %.4g k2 %.4g k3 %.4g p1 %.4g "
              "p2 %.4g, rms %.3g px\n",
              name,
              lens.fx,
              lens.fy,
              lens.cx,
              lens.cy,
              lens.k[0],
              lens.k[1],
              lens.k[2],
              lens.p[0],
              lens.p[1],
              rms);
}

void
calibrateOne(const CalibrateSettings& s, const std::vector<fs::path>& files)
{
  const Views views = findBoards(files, s.board);
  std::vector<CalibrationView> seen;
  for (const auto& view : views.found)
    if (view)
      seen.push_back(*view);
  requireBoards(s, seen.size(), files.size());
  const CameraCalibration result =
      calibrateCamera(seen, views.size.width, views.size.height, s.options);
  requireAnswer(s, result.status);
  writeCamera(s.output, result.camera);
  printMissing(views);
  std::printf("%zu of %zu pictures show the board\n", seen.size(), views.files.size());
  printCamera("camera", result.camera, result.rms);
}

/** The pictures of a stereo rig in their pairs. */
struct Pairs {
  std::vector<fs::path> left, right;
};

void
calibratePair(const CalibrateSettings& s, const Pairs& pairs)
{
  const Views left = findBoards(pairs.left, s.board);
  const Views right = findBoards(pairs.right, s.board);
  if (left.size != right.size)
    throw IoFailed(
        pairs.right.front().string() + ": has " + std::to_string(right.size.width) +
        " x " + std::to_string(right.size.height) + " pixels, but " +
        pairs.left.front().string() + " has " + std::to_string(left.size.width) +
        " x " + std::to_string(left.size.height));
  std::vector<CalibrationView> seen_left, seen_right;
  for (std::size_t i = 0; i < left.found.size(); ++i)
    if (left.found[i] && right.found[i]) {
      seen_left.push_back(*left.found[i]);
      seen_right.push_back(*right.found[i]);
    }
  requireBoards(s, seen_left.size(), left.found.size());
  const StereoCameraCalibration result = calibrateStereo(
      seen_left, seen_right, left.size.width, left.size.height, s.options);
  requireAnswer(s, result.status);
  writeStereoCalibration(s.output, result.calibration);
  printMissing(left);
  printMissing(right);
  std::printf("%zu of %zu pairs show the board\n", seen_left.size(), left.found.size());
  printCamera("left camera", result.calibration.left, result.rms_left);
  printCamera("right camera", result.calibration.right, result.rms_right);
  std::printf("baseline %.6g m, rms of the pairs %.3g px\n",
              result.calibration.T_right_left.translation().norm(),
              result.rms);
}

bool
startsWith(const fs::path& file, const std::string& word)
{
  return file.filename().string().compare(0, word.size(), word) == 0;
}

/** \return left* and right* of a folder; empty if either is missing */
std::optional<Pairs>
pairsByName(const std::vector<fs::path>& files)
{
  Pairs pairs;
  for (const auto& file : files)
    if (startsWith(file, "left"))
      pairs.left.push_back(file);
    else if (startsWith(file, "right"))
      pairs.right.push_back(file);
  if (pairs.left.empty() || pairs.right.empty())
    return {};
  return pairs;
}

/** \throws IoFailed a picture has no partner */
void
requirePairs(const Pairs& pairs)
{
  const auto rest = [](const fs::path& file, const std::string& word) {
    const std::string name = file.stem().string();
    return startsWith(file, word) ? name.substr(word.size()) : name;
  };
  const std::size_t shared = std::min(pairs.left.size(), pairs.right.size());
  for (std::size_t i = 0; i < shared; ++i)
    if (rest(pairs.left[i], "left") != rest(pairs.right[i], "right"))
      throw IoFailed(pairs.left[i].string() + " and " + pairs.right[i].string() +
                     ": are no pair by their names");
  if (pairs.left.size() != pairs.right.size())
    throw IoFailed(
        (pairs.left.size() > shared ? pairs.left : pairs.right)[shared].string() +
        ": has no partner");
}
} // namespace

int
runCalibrate(const std::vector<std::string>& arguments)
{
  CalibrateSettings s;
  if (!parse(arguments, s))
    return kDone;
  const std::vector<fs::path> files = imagesOf(s.input);
  std::optional<Pairs> pairs;
  if (!s.right.empty())
    pairs = Pairs{files, imagesOf(s.right)};
  else
    pairs = pairsByName(files);
  if (pairs) {
    requirePairs(*pairs);
    calibratePair(s, *pairs);
  }
  else
    calibrateOne(s, files);
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app

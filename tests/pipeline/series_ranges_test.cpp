// SPDX-License-Identifier: Apache-2.0
// Ranges of headings and radii are exact: a hundredth inside a contour of the same runs exists and
// is proved, a hundredth outside there is none.
#include "fit/series_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "../common/long_runs.h"
#include "../common/oracle_curves.h"
#include "../common/ten_points.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using namespace test;
using pipeline_detail::series_ranges;

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
constexpr double kProbe = 0.01;  // of the range, inside and outside of its ends

/// Whether a contour with the wish exists, is proved and has no more vertices and inflections
/// than the adjacent circles show.
bool exists(const std::vector<Vec2>& points, const PointConstraint& wish,
            const Analysis& analysis) {
  PointSeries series;
  series.points = points;
  FitJob job;
  job.closing = Closing::kOpen;
  job.find_corners = false;
  job.measure_against_spirals = false;
  job.constraints.push_back(wish);
  const auto made = fit(series, job);
  return made && made->certificate.proved && made->certificate.vertices <= analysis.vertices &&
         made->certificate.inflections <= analysis.inflections;
}

struct Probes {
  int inside_good = 0, inside_bad = 0, outside_good = 0, outside_bad = 0;
  std::string first_bad;
};

template <class Wish>
void probe(const std::vector<Vec2>& points, const Analysis& analysis, double low, double high,
           bool low_open, bool high_open, const Wish& wish, const std::string& what, Probes& p) {
  const double step = kProbe * (high - low);
  const auto look = [&](double value, bool inside) {
    const bool is = exists(points, wish(value), analysis);
    (inside ? (is ? p.inside_good : p.inside_bad) : (is ? p.outside_bad : p.outside_good))++;
    if (is != inside && p.first_bad.empty()) {
      p.first_bad = what + (inside ? " inside " : " outside ") + std::to_string(value) + " of " +
                    std::to_string(low) + " " + std::to_string(high);
    }
  };
  if (!low_open) {
    look(low + step, true);
    look(low - step, false);
  }
  if (!high_open) {
    look(high - step, true);
    look(high + step, false);
  }
}

void probe_point(const std::vector<Vec2>& points, std::size_t i, Probes& p) {
  const auto analysis = analyse(points);
  ASSERT_TRUE(analysis);
  const auto ranges = series_ranges(*analysis, {});
  ASSERT_TRUE(ranges);
  const FeasibleData& here = (*ranges)[i];
  if (!here.heading || !here.kappa) return;
  probe(
      points, *analysis, here.heading->low, here.heading->high, here.heading->low_is_open,
      here.heading->high_is_open,
      [i](double theta) {
        return PointConstraint{i, theta, {}, false};
      },
      "heading " + std::to_string(i + 1), p);
  if (std::isinf(here.kappa->low) || std::isinf(here.kappa->high)) return;
  probe(
      points, *analysis, here.kappa->low, here.kappa->high, here.kappa->low == 0.0,
      here.kappa->high == 0.0,
      [i](double kappa) {
        return PointConstraint{i, {}, kappa, false};
      },
      "curvature " + std::to_string(i + 1), p);
}

TEST(SeriesRanges, OfTheTenPointsAreExact) {
  Probes p;
  for (std::size_t i = 0; i < kTenPoints.size(); ++i) probe_point(kTenPoints, i, p);
  EXPECT_EQ(p.inside_bad, 0) << p.first_bad;
  EXPECT_EQ(p.outside_bad, 0) << p.first_bad;
  EXPECT_GT(p.inside_good + p.outside_good, 60);
}

/// Points on a curve of monotone curvature in similar steps (1:3), whose neighbouring chords turn
/// by less than 80 degrees.
std::vector<Vec2> random_points(int k, std::mt19937_64& rng) {
  for (;;) {
    const auto kind = static_cast<Oracle>(k % kOracleCount);
    const OracleCurve curve = random_curve(kind, rng);
    const int n = 4 + static_cast<int>(rng() % 9U);
    std::vector<Vec2> points;
    for (const long double t : random_parameters(curve, n, false, rng)) {
      const LongVec2 p = curve.at(t);
      points.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    }
    if (largest_turning(points) < 80.0 / kDegreesOfRadian) return points;
  }
}

TEST(SeriesRanges, OfRandomSpiralsAreExact) {
  std::mt19937_64 rng(20261101);
  Probes p;
  const int cases = test::cases_of(500, 5);
  for (int k = 0; k < cases; ++k) {
    const std::vector<Vec2> points = random_points(k, rng);
    probe_point(points, rng() % points.size(), p);
  }
  EXPECT_EQ(p.inside_bad, 0) << p.first_bad;
  EXPECT_EQ(p.outside_bad, 0) << p.first_bad;
  EXPECT_GT(p.inside_good, 3 * cases / 2);
  EXPECT_GT(p.outside_good, 3 * cases / 2);
}

/// Points of known curves in steps of 1:1000, and nearly straight ones: close to the ends of ranges
/// curvature leaps there. The heading lies a hundredth inside.
struct UnevenSeries {
  std::string name;
  std::vector<Vec2> points;
  std::size_t point;
  double heading_deg;
};
/// On a parabola, four groups of points close together.
const std::vector<Vec2> kParabola = {
    {0.62408184480688222, -0.72729166372835041},  {0.62381317868049291, -0.72663104700042014},
    {0.62354439871066381, -0.72597070516213025},  {0.29778578730611621, -0.20321113191324186},
    {0.29740305005313622, -0.20282595460503397},  {0.2970201989567165, -0.20244105218646652},
    {0.2966372340168571, -0.20205642465753948},   {0.29625415523355791, -0.20167207201825291},
    {0.29587096260681911, -0.20128799426860677},  {0.29548765613664052, -0.20090419140860108},
    {-0.14479745561737972, 0.045316403556105174}, {-0.1452947193707092, 0.045425041886028895},
    {-0.69953711427564602, 0.016481106768760679}, {-0.7001483353121265, 0.016314580568602424},
    {-0.70075967019204655, 0.016147779478803727}, {-0.70137111891540638, 0.01598070349936459},
    {-1.3697984838506823, -0.28867754098076115},  {-1.370523889857193, -0.28911978149028228},
    {-1.3712494097071435, -0.28956229688944385},  {-1.3719750434005338, -0.29000508717824586},
    {-1.3727007909373636, -0.29044815235668825},  {-1.3734266523176331, -0.29089149242477114},
    {-1.3741526275413425, -0.29133510738249446}};

/// On a logarithmic spiral.
const std::vector<Vec2> kLogarithmic = {
    {0.029633425051708257, -0.039280105163102479}, {0.029647422481534715, -0.039272533614285079},
    {0.029694529777195489, -0.039247009613253829}, {0.029852963018488228, -0.039160683951643745},
    {0.030384622191798206, -0.038865518874647856}, {0.032154283480989913, -0.037820403624892154},
    {0.037844695461840695, -0.033729310800654354}, {0.052538599676801884, -0.014124174420461356},
    {0.018202251484724402, 0.066562520077588755},  {0.1470440455776954, 0.044521569585087149},
    {1.5776775979383568, -1.6366477735261971}};

/// A zigzag of some 1e-4 of its steps.
const std::vector<Vec2> kZigzag = {
    {3141325.2729622815, 2088518.4463188951}, {3141324.9870817498, 2088518.3692141469},
    {3141324.7012066157, 2088518.2920893908}, {3141324.4153260845, 2088518.2149846426},
    {3141324.1294509503, 2088518.1378598865}, {3141323.8435704187, 2088518.0607551385},
    {3141323.5576952845, 2088517.9836303822}, {3141323.2718147533, 2088517.9065256342},
    {3141322.9859396191, 2088517.8294008782}, {3141322.7000590879, 2088517.7522961299},
    {3141322.4141839533, 2088517.6751713739}, {3141322.1283034221, 2088517.5980666257},
    {3141321.842428288, 2088517.5209418696}};

/// Groups of points close together and far from each other, far from the origin.
const std::vector<Vec2> kSpread = {
    {17526692101.793606, 8275864823.9059896}, {17526692106.471199, 8275864822.9085016},
    {17526692111.138577, 8275864821.9233456}, {17526692115.795731, 8275864820.9505215},
    {17526692120.442669, 8275864819.9900303}, {17526692125.079384, 8275864819.0418711},
    {17526692129.705883, 8275864818.1060438}, {17526692134.322163, 8275864817.1825485},
    {17526692138.928223, 8275864816.2713852}, {17526692143.524063, 8275864815.3725548},
    {17526692148.109684, 8275864814.4860563}, {17526692152.685085, 8275864813.6118908},
    {17526692157.250267, 8275864812.7500563}, {17526692161.805233, 8275864811.9005547},
    {17526692166.349976, 8275864811.063385},  {17526692170.884502, 8275864810.2385483},
    {17526692175.408806, 8275864809.4260426}, {17526692179.922894, 8275864808.6258698},
    {17526691579.281609, 8275870180.723403},  {17526680759.403957, 8275887885.0296326},
    {17526680743.469353, 8275887908.906209},  {17526680727.524529, 8275887932.7951174}};

/// Nearly on a line.
const std::vector<Vec2> kNearlyStraight = {{0, -4.7582191688360266e-09},
                                           {1144.3772610252502, -7.8855461637332582e-09},
                                           {2288.7545220505003, 4.0575191146654478e-09},
                                           {3433.1317830757507, -3.3670894737766189e-09},
                                           {4577.5090441010007, -4.7074752076298144e-10},
                                           {5721.8863051262515, -2.006410200364203e-09},
                                           {6866.2635661515014, -1.816514475612887e-09},
                                           {8010.6408271767514, 6.1166668459183641e-09},
                                           {9155.0180882020013, -6.0588888799895109e-09},
                                           {10299.395349227252, -2.5235656643902449e-09},
                                           {11443.772610252503, 7.3432185716982544e-10},
                                           {12588.149871277752, 6.7615911659247479e-09},
                                           {13732.527132303003, -9.906705004870705e-09},
                                           {14876.904393328254, -3.2805976019836599e-10},
                                           {16021.281654353503, 5.0105031806141519e-09},
                                           {17165.658915378754, -2.1115453201249982e-09},
                                           {18310.036176404003, 3.6249373410040217e-09},
                                           {19454.413437429255, -3.1850150003577927e-09},
                                           {20598.790698454504, -4.7936168839445501e-10},
                                           {21743.167959479753, -3.06466222767089e-09},
                                           {22887.545220505006, -1.5380699544323853e-09},
                                           {24031.922481530255, 8.7811466871730937e-09}};

/// On a sine, two points twice within 1e-7 of the others' steps.
const std::vector<Vec2> kSineWithTwins = {{0, 0},
                                          {0.61191355177478557, 0.081952496412056777},
                                          {1.2238271035495711, 0.010966370545463769},
                                          {1.8357406553243569, -0.080485045288472432},
                                          {2.4476542070991423, -0.021736375958892152},
                                          {2.4476761922392951, -0.021732096251171725},
                                          {3.0595897440140809, 0.077577877421807676},
                                          {3.6715032957888663, 0.032113082641879759},
                                          {4.283416847563652, -0.073280705535337304},
                                          {4.8953303993384374, -0.041919048364911699},
                                          {5.5072439511132227, 0.067671360641540904},
                                          {6.119157502888009, 0.050974406634652851},
                                          {6.1191576034188966, 0.050974390722406837},
                                          {6.7310711551936819, -0.06085029796597758},
                                          {7.3429847069684673, -0.059116997043287829}};

/// On a circle, each rounded.
const std::vector<Vec2> kRounded = {
    {42.403698308516859, -156.22810649672019}, {46.866417067566928, -154.94784230885483},
    {51.290586266088958, -153.54012713456098}, {55.672566866804175, -152.00611894378181},
    {60.008754447659221, -150.34707934881297}, {64.295582388695422, -148.56437317140896},
    {68.529524552536429, -146.65946664621913}, {72.70709836469446, -144.63392667775238},
    {76.824867569845978, -142.4894193003143},  {80.879445197315732, -140.22770857926571},
    {84.867496090414647, -137.85065468896013}, {88.785739993235268, -135.36021299463118},
    {92.630953994942814, -132.75843198912727}, {96.39997517343194, -130.04745163571843},
    {100.08970341724778, -127.22950191974139}, {103.69710372804508, -124.30690066299773},
    {107.2192089561207, -121.28205192782691},  {110.65312192620038, -118.15744366014717},
    {113.99601815252085, -114.93564603604428}, {117.24514794550669, -111.61930909641515},
    {120.39783881462013, -108.21116071397702}, {123.45149744265252, -104.7140041406977},
    {126.40361217945188, -101.13071602833064}, {129.25175466204885, -97.464243675779372},
    {131.99358228486815, -93.71760299493701},  {134.62683978100407, -89.893875746973592},
    {137.14936111861178, -85.996207057566167}, {139.5590714237571, -82.027802926243851},
    {141.85398873619664, -77.991927601545328}, {144.03222521890913, -73.891900657865392},
    {146.09198927230639, -69.731094587646496}, {148.03158667285743, -65.512931831686544},
    {149.84942195010316, -61.240881970395975}, {151.54399993934763, -56.918458975041005},
    {153.11392667006191, -52.549218175131102}, {154.55791100008909, -48.136753516585344}};

/// A line, three parts of a circle and a line, six digits.
const std::vector<Vec2> kLineArcLine = {
    {-9.302673, 14.25715},  {-13.49029, 11.52477},  {-17.67791, 8.792382},  {-21.86552, 6.059998},
    {-26.05314, 3.327613},  {-32.65663, -4.863235}, {-33.18451, -15.3712},  {-27.43514, -24.18261},
    {-17.60459, -27.93179}, {-7.447793, -25.18669}, {-3.260176, -22.45431}, {0.9274401, -19.72192},
    {5.115056, -16.98954}};

/// On a circle, rounded to the fifth digit.
const std::vector<Vec2> kFiveOfACircle = {{-11.7721, 16.04826},
                                          {-12.95922, 15.10588},
                                          {-14.07119, 14.07589},
                                          {-15.10155, 12.96426},
                                          {-16.04433, 11.77745}};

/// On a circle but for some 1e-10 of it.
const std::vector<Vec2> kTwelveOfACircle = {
    {-14.674217479155717, 0.026484111130724453}, {-13.494052716012074, -5.7657524524399326},
    {-10.124167351047353, -10.622362988844662},  {-5.1114028402079299, -13.755250671715192},
    {0.73080441400856933, -14.656032374201503},  {6.4544218336589969, -13.178535534647629},
    {11.130660770968229, -9.562518018258773},    {14.000693841474725, -4.3947618849156234},
    {14.598792127293823, 1.4861455041699529},    {12.827900420260963, 7.1258915834857346},
    {8.975386652352741, 11.609297760281976},     {3.6664098435978074, 14.208828202613722}};

/// A zigzag of five points that turns by 72 degrees.
const std::vector<Vec2> kSteepZigzag = {
    {0, 1.2259}, {3.37922, -1.2259}, {6.75844, 1.2259}, {10.1377, -1.2259}, {13.5169, 1.2259}};

/// A zigzag of 18 points.
const std::vector<Vec2> kLongZigzag = {
    {0.0034003292870060432, -0.012531271757517129}, {-0.51927087889642021, -0.12744891318169674},
    {-1.0283407699318223, -0.29249164163594482},    {-1.5510119781152487, -0.40740928306012442},
    {-2.0600818691506508, -0.57245201151437253},    {-2.5827530773340768, -0.68736965293855212},
    {-3.0918229683694789, -0.85241238139280029},    {-3.6144941765529053, -0.96733002281697988},
    {-4.1235640675883074, -1.1323727512712281},     {-4.6462352757717333, -1.2472903926954075},
    {-5.1553051668071355, -1.4123331211496557},     {-5.6779763749905623, -1.5272507625738352},
    {-6.1870462660259644, -1.6922934910280834},     {-6.7097174742093904, -1.8072111324522631},
    {-7.2187873652447925, -1.9722538609065112},     {-7.7414585734282184, -2.0871715023306909},
    {-8.2505284644636205, -2.2522142307849387},     {-8.7731996726470474, -2.3671318722091184}};

/// A zigzag of 36 points, the heading near an end of the range of its middle.
const std::vector<Vec2> kZigzagHalfWay = {{0, 2.34097e-13},           {4.90131e-08, -2.34097e-13},
                                          {9.80262e-08, 2.34097e-13}, {1.47039e-07, -2.34097e-13},
                                          {1.96052e-07, 2.34097e-13}, {2.45065e-07, -2.34097e-13},
                                          {2.94079e-07, 2.34097e-13}, {3.43092e-07, -2.34097e-13},
                                          {3.92105e-07, 2.34097e-13}, {4.41118e-07, -2.34097e-13},
                                          {4.90131e-07, 2.34097e-13}, {5.39144e-07, -2.34097e-13},
                                          {5.88157e-07, 2.34097e-13}, {6.3717e-07, -2.34097e-13},
                                          {6.86183e-07, 2.34097e-13}, {7.35196e-07, -2.34097e-13},
                                          {7.84209e-07, 2.34097e-13}, {8.33222e-07, -2.34097e-13},
                                          {8.82236e-07, 2.34097e-13}, {9.31249e-07, -2.34097e-13},
                                          {9.80262e-07, 2.34097e-13}, {1.02927e-06, -2.34097e-13},
                                          {1.07829e-06, 2.34097e-13}, {1.1273e-06, -2.34097e-13},
                                          {1.17631e-06, 2.34097e-13}, {1.22533e-06, -2.34097e-13},
                                          {1.27434e-06, 2.34097e-13}, {1.32335e-06, -2.34097e-13},
                                          {1.37237e-06, 2.34097e-13}, {1.42138e-06, -2.34097e-13},
                                          {1.47039e-06, 2.34097e-13}, {1.51941e-06, -2.34097e-13},
                                          {1.56842e-06, 2.34097e-13}, {1.61743e-06, -2.34097e-13},
                                          {1.66644e-06, 2.34097e-13}, {1.71546e-06, -2.34097e-13}};

TEST(SeriesRanges, OfUnevenPointsAreUsedByFit) {
  const UnevenSeries all[] = {{"parabola", kParabola, 10, 166.60243238194005},
                              {"logarithmic", kLogarithmic, 9, -12.166311890260006},
                              {"zigzag", kZigzag, 9, -164.93560373765663},
                              {"spread", kSpread, 17, 72.777804010356689},
                              {"nearly straight", kNearlyStraight, 0, -0.90000000053007012},
                              {"sine with twins", kSineWithTwins, 11, -7.3922517619656984},
                              {"rounded", kRounded, 0, 14.293687267224959},
                              {"line, arc, line", kLineArcLine, 9, 33.087029816425343},
                              {"five of a circle", kFiveOfACircle, 0, -143.65546240017056},
                              {"twelve of a circle", kTwelveOfACircle, 0, -90.887210115696647},
                              {"steep zigzag", kSteepZigzag, 0, -72.466049655806827},
                              {"long zigzag", kLongZigzag, 9, -208.48669526194482},
                              {"zigzag, half way", kZigzagHalfWay, 7, -0.006206530355445038}};
  for (const UnevenSeries& one : all) {
    PointSeries series;
    series.points = one.points;
    const auto free = fit(series, {});
    ASSERT_TRUE(free) << one.name;
    FitJob job;
    PointConstraint wish;
    wish.index = one.point;
    wish.theta = one.heading_deg / kDegreesOfRadian;
    job.constraints.push_back(wish);
    const auto made = fit(series, job);
    ASSERT_TRUE(made) << one.name << ": " << made.error().what;
    EXPECT_TRUE(made->certificate.proved) << one.name << ": " << made->certificate.reason;
    EXPECT_LE(made->certificate.vertices, free->certificate.vertices) << one.name;
    EXPECT_LE(made->certificate.inflections, free->certificate.inflections) << one.name;
  }
}

/// What three points leave where the last heading asks for an inflection that their circle does not
/// show: near the end of the range of the middle one.
TEST(SeriesRanges, OfThreePointsAreUsedByFit) {
  PointSeries series;
  series.points = {{41933.140165385528, 16062.808270540871},
                   {41979.377158322124, 16046.98499037343},
                   {42011.495633582752, 16078.090204717177}};
  const auto with = [&](double heading_deg) {
    FitJob job;
    PointConstraint last, middle;
    last.index = 2;
    last.theta = 32.339278022 / kDegreesOfRadian;
    middle.index = 1;
    middle.theta = heading_deg / kDegreesOfRadian;
    job.constraints = {last, middle};
    return fit(series, job);
  };
  // the range is 14.1537 to 55.8244 degrees
  const auto inside = with(14.570440494398722);
  ASSERT_TRUE(inside) << inside.error().what;
  EXPECT_TRUE(inside->certificate.proved);
  EXPECT_EQ(inside->certificate.vertices, 0);
  EXPECT_EQ(inside->certificate.inflections, 1);
  EXPECT_FALSE(with(13.74));
}

/// The last heading of four points asks for an inflection that their circles do not show; so do the
/// headings of the second one near the lower end of its range, which is -42.8714 to -33.6466
/// degrees.
TEST(SeriesRanges, BesideAnInflectionThatDataAskForAreUsedByFit) {
  PointSeries series;
  series.points = {{94.978810576306969, 614.50641273223164},
                   {96.788010112419016, 614.29535767136986},
                   {97.458930577304998, 613.54598271559018},
                   {97.964908569634659, 612.71860295464774}};
  const auto with = [&](std::optional<double> heading_deg) {
    FitJob job;
    PointConstraint last, second;
    last.index = 3;
    last.theta = 316.372814038 / kDegreesOfRadian;
    job.constraints = {last};
    if (heading_deg) {
      second.index = 1;
      second.theta = *heading_deg / kDegreesOfRadian;
      job.constraints.push_back(second);
    }
    return fit(series, job);
  };
  const auto free = with({});
  ASSERT_TRUE(free) << free.error().what;
  EXPECT_EQ(free->certificate.inflections, 1);
  for (const double heading_deg : {-42.779197463089425, -42.5, -41.5, -33.8}) {
    const auto made = with(heading_deg);
    ASSERT_TRUE(made) << heading_deg << ": " << made.error().what;
    EXPECT_TRUE(made->certificate.proved) << heading_deg;
    EXPECT_EQ(made->certificate.vertices, 0) << heading_deg;
    EXPECT_EQ(made->certificate.inflections, 1) << heading_deg;
  }
  EXPECT_FALSE(with(-43.2));
}

}  // namespace
}  // namespace obvid

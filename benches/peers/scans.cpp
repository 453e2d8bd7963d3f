// Range scans inserted into a grid: a plain one of floats, and MRPT's COccupancyGridMap2D::insertObservation.
//
//     scans FILE RESOLUTION plain|mrpt
//
// Each line of FILE is a scan: x, y and heading of the laser (metres, radians), the number of beams, as many ranges
// (metres), from -90 degrees on, counter-clockwise over half a turn; 50 m and more is no return. Prints name, seconds of
// the least of some runs, and cells observed, with tabs between. `cargo bench --bench peers -- scans` compiles and runs it.
#ifdef WITH_MRPT
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/version.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

struct Scan {
    double x, y, theta;
    std::vector<float> ranges;
};

constexpr float NO_RETURN = 50;
constexpr double PI = 3.14159265358979323846;

// Processor time of this thread: unlike the clock, it stands still while others run.
static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

static std::vector<Scan> read(const char* name) {
    std::ifstream file(name);
    std::vector<Scan> scans;
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        Scan scan;
        size_t count;
        words >> scan.x >> scan.y >> scan.theta >> count;
        scan.ranges.resize(count);
        for (float& range : scan.ranges) words >> range;
        scans.push_back(std::move(scan));
    }
    return scans;
}

// Log-odds in floats over a fixed rectangle, clamped as OctoMap does; each cell of a beam by Bresenham's line, once a beam.
struct Plain {
    static constexpr int SIDE = 4000;
    std::vector<float> cells = std::vector<float>(static_cast<size_t>(SIDE) * SIDE);
    float resolution;

    explicit Plain(float side) : resolution(side) {}

    int cell(double x) const { return static_cast<int>(std::floor(x / static_cast<double>(resolution))) + SIDE / 2; }

    void add(int x, int y, float l) {
        if (x < 0 || y < 0 || x >= SIDE || y >= SIDE) return;
        float& sum = cells[static_cast<size_t>(y) * SIDE + static_cast<size_t>(x)];
        sum = std::min(std::max(sum + l, -50.F), 50.F);
    }

    void insert(const Scan& scan) {
        const int x0 = cell(scan.x), y0 = cell(scan.y);
        const double step = PI / static_cast<double>(scan.ranges.size());
        for (size_t k = 0; k < scan.ranges.size(); k++) {
            const double range = static_cast<double>(scan.ranges[k]);
            if (range >= static_cast<double>(NO_RETURN)) continue;
            const double angle = scan.theta - PI / 2 + static_cast<double>(k) * step;
            const int x1 = cell(scan.x + range * std::cos(angle)), y1 = cell(scan.y + range * std::sin(angle));
            const int dx = std::abs(x1 - x0), dy = -std::abs(y1 - y0), sx = x0 < x1 ? 1 : -1, sy = y0 < y1 ? 1 : -1;
            int x = x0, y = y0, error = dx + dy;
            while (x != x1 || y != y1) {
                add(x, y, -0.405F);
                const int twice = 2 * error;
                if (twice >= dy) error += dy, x += sx;
                if (twice <= dx) error += dx, y += sy;
            }
            add(x1, y1, 0.847F);
        }
    }

    long observed() const { return std::count_if(cells.begin(), cells.end(), [](float l) { return l != 0; }); }
};

// The least time of some runs of `insert`, each into a map of its own that `make` gives.
template <class Make, class Insert, class Observed>
static void measure(const char* name, const std::vector<Scan>& scans, Make make, Insert insert, Observed observed) {
    double least = 1e9;
    long cells = 0;
    for (int run = 0; run < 5; run++) {
        auto map = make();
        const double start = now();
        for (size_t k = 0; k < scans.size(); k++) insert(map, scans[k], k);
        least = std::min(least, now() - start);
        cells = observed(map);
    }
    std::printf("%s\t%.9g\t%ld\n", name, least, cells);
}

#ifdef WITH_MRPT
static void by_mrpt(const std::vector<Scan>& scans, float resolution) {
    using namespace mrpt;
    std::vector<obs::CObservation2DRangeScan> readings(scans.size());
    std::vector<poses::CPose3D> places;
    for (size_t k = 0; k < scans.size(); k++) {
        const Scan& scan = scans[k];
        auto& reading = readings[k];
        const size_t count = scan.ranges.size();
        // From -90 degrees to one step before 90: turned by half of it, as MRPT's beams are about the middle.
        const double step = PI / static_cast<double>(count);
        reading.aperture = static_cast<float>(PI - step);
        reading.rightToLeft = true;
        reading.maxRange = 81;
        reading.resizeScan(count);
        for (size_t beam = 0; beam < count; beam++) {
            reading.setScanRange(beam, scan.ranges[beam]);
            reading.setScanRangeValidity(beam, scan.ranges[beam] < NO_RETURN);
        }
        places.emplace_back(scan.x, scan.y, 0.0, scan.theta - step / 2, 0.0, 0.0);
    }
    char name[64];
    std::snprintf(name, sizeof name, "MRPT %d.%d.%d insertObservation", MRPT_VERSION >> 8 & 15, MRPT_VERSION >> 4 & 15,
                  MRPT_VERSION & 15);
    const auto make = [&] {
        maps::COccupancyGridMap2D map(-1, 1, -1, 1, resolution);
        // All of each beam, one cell wide; each beam counts.
        map.insertionOptions.maxDistanceInsertion = NO_RETURN;
        map.insertionOptions.wideningBeamsWithDistance = false;
        map.insertionOptions.decimation = 1;
        return map;
    };
    const auto insert = [&](maps::COccupancyGridMap2D& map, const Scan&, size_t k) {
        map.insertObservation(readings[k], places[k]);
    };
    const auto observed = [](const maps::COccupancyGridMap2D& map) {
        const auto& cells = map.getRawMap();
        return static_cast<long>(std::count_if(cells.begin(), cells.end(), [](auto cell) { return cell != 0; }));
    };
    measure(name, scans, make, insert, observed);
}
#endif

int main(int count, char** arguments) {
    if (count != 4) return 2;
    const std::vector<Scan> scans = read(arguments[1]);
    const float resolution = std::strtof(arguments[2], nullptr);
    if (!std::strcmp(arguments[3], "plain")) {
        const auto insert = [](Plain& map, const Scan& scan, size_t) { map.insert(scan); };
        const auto observed = [](const Plain& map) { return map.observed(); };
        measure("plain grid of floats, Bresenham", scans, [&] { return Plain(resolution); }, insert, observed);
    }
#ifdef WITH_MRPT
    if (!std::strcmp(arguments[3], "mrpt")) by_mrpt(scans, resolution);
#endif
    return 0;
}

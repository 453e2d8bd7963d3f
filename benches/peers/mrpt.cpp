// The mean information of a map of bytes by MRPT's COccupancyGridMap2D::computeEntropy.
//
//     mrpt FILE
//
// FILE holds SIDE x SIDE bytes, log-odds of being free times 16. Prints name, seconds and value, with tabs between.
// `cargo bench --bench peers` compiles and runs it where MRPT is installed.
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/version.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

// Processor time of this thread: unlike the clock, it stands still while others run.
static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

int main(int count, char** arguments) {
    constexpr unsigned SIDE = 4000;
    using Map = mrpt::maps::COccupancyGridMap2D;
    std::FILE* file = count == 2 ? std::fopen(arguments[1], "rb") : nullptr;
    if (!file) return 2;
    Map map;
    map.setSize(0, SIDE * 0.0625F, 0, SIDE * 0.0625F, 0.0625F);
    if (map.getSizeX() != SIDE || map.getSizeY() != SIDE) return 1;
    for (unsigned y = 0; y < SIDE; y++)
        if (std::fread(map.getRow(static_cast<int>(y)), 1, SIDE, file) != SIDE) return 1;
    Map::TEntropyInfo info;
    double least = 1e9;
    const double begin = now();
    for (int run = 0; run < 5 || now() - begin < 1; run++) {
        const double start = now();
        map.computeEntropy(info);
        least = std::min(least, now() - start);
    }
    std::printf("MRPT %d.%d.%d computeEntropy\t%.9g\t%.17g\n", MRPT_VERSION >> 8 & 15, MRPT_VERSION >> 4 & 15,
                MRPT_VERSION & 15, least, info.mean_I);
}

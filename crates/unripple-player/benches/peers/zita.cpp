// Convolution of all inputs into all outputs by zita-convolver. Arguments: inputs, outputs, taps, block, largest partition,
// blocks. The first blocks, until all of the responses is in use, are not counted.
//
// Prints the processor seconds of the calling thread in each block, and those of all threads per block on average.

#include <zita-convolver.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

static double now(clockid_t clock) {
    timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

int main(int argc, char **argv) {
    if (argc != 7) return 2;
    const int inputs = atoi(argv[1]), outputs = atoi(argv[2]), taps = atoi(argv[3]);
    const int block = atoi(argv[4]), largest = atoi(argv[5]), blocks = atoi(argv[6]);
    Convproc convolver;
    convolver.set_options(Convproc::OPT_FFTW_MEASURE | Convproc::OPT_VECTOR_MODE);
    if (convolver.configure(inputs, outputs, taps, block, block, largest, 1.0f)) return 1;
    unsigned state = 1;
    auto noise = [&state] {
        state = state * 1664525u + 1013904223u;
        return (int)state / 2147483648.0f;
    };
    std::vector<float> response(taps);
    for (int i = 0; i < inputs; i++)
        for (int o = 0; o < outputs; o++) {
            for (float &x : response) x = 0.01f * noise();
            if (convolver.impdata_create(i, o, 1, response.data(), 0, taps)) return 1;
        }
    if (convolver.start_process(0, SCHED_OTHER)) return 1;
    std::vector<double> seconds;
    double all = 0;
    for (int b = -taps / block - 8; b < blocks; b++) {
        if (b == 0) all = now(CLOCK_PROCESS_CPUTIME_ID);
        for (int i = 0; i < inputs; i++)
            for (int k = 0; k < block; k++) convolver.inpdata(i)[k] = noise();
        const double start = now(CLOCK_THREAD_CPUTIME_ID);
        convolver.process(true);
        const double end = now(CLOCK_THREAD_CPUTIME_ID);
        if (b >= 0) seconds.push_back(end - start);
    }
    all = now(CLOCK_PROCESS_CPUTIME_ID) - all;
    convolver.stop_process();
    convolver.cleanup();
    printf("seconds");
    for (double s : seconds) printf(" %.9g", s);
    printf("\nall %.9g\n", all / blocks);
}

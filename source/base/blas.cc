#include <vibrocontact/base/blas.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <vector>

extern "C" void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *,
                       const double *, const int *, const double *, const int *, const double *, double *,
                       const int *);

namespace vibrocontact
{
  void set_one_blas_thread()
  {
    if (auto *set_threads = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set_threads(1);
  }

  Blas measure_blas()
  {
    Blas blas;
    Dl_info info;
    if (dladdr(reinterpret_cast<void *>(&dgemm_), &info) && info.dli_fname)
      blas.library = info.dli_fname;
    // In a program linked to shared libraries the address above may be that of a jump table: ask the loader.
    if (void *symbol = dlsym(RTLD_DEFAULT, "dgemm_"))
      if (dladdr(symbol, &info) && info.dli_fname)
        blas.library = info.dli_fname;
    if (char *real = realpath(blas.library.c_str(), nullptr))
    {
      blas.library = real;
      std::free(real);
    }

    const int n = 384;
    const double one = 1, zero = 0;
    std::vector<double> a(n * n, 1.), b(n * n, 0.5), c(n * n, 0.);
    for (int trial = 0; trial < 4; ++trial)
    {
      const auto begin = std::chrono::steady_clock::now();
      dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      blas.gflops = std::max(blas.gflops, 2e-9 * n * n * n / seconds);
    }
    return blas;
  }
} // namespace vibrocontact

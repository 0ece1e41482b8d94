#include <vibrocontact/base/blas.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>

extern "C" void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *,
                       const double *, const int *, const double *, const int *, const double *, double *,
                       const int *);

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Whether a folder's name says that it holds a faster library.
    bool is_of_faster_blas(const std::string &folder)
    {
      for (const char *name : {"openblas", "blis", "atlas", "mkl", "flexiblas"})
        if (folder.find(name) != std::string::npos)
          return true;
      return false;
    }

    /// a function of the library that is loaded, or null
    template <typename Function>
    Function *loaded(const char *name)
    {
      return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
    }

    void choose_kernels()
    {
      __builtin_cpu_init();
      const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"),
                 has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                              __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                              __builtin_cpu_supports("avx512vl");
      const std::string better = better_kernels(blas_kernels(), has_avx2, has_avx512);
      auto *const leave = loaded<void()>("gotoblas_dynamic_quit"), *const choose = loaded<void()>(
                                                                       "gotoblas_dynamic_init");
      if (better.empty() || leave == nullptr || choose == nullptr)
        return;
      // an entry of the environment is not overwritten, and stays for the programs that draw figures
      setenv("OPENBLAS_CORETYPE", better.c_str(), 0);
      leave();
      choose();
    }
  } // namespace

  std::string blas_kernels()
  {
    auto *const name = loaded<char *()>("openblas_get_corename");
    return name == nullptr ? "" : name();
  }

  std::string better_kernels(const std::string &kernels, const bool has_avx2, const bool has_avx512)
  {
    // what OpenBLAS falls back to, none of which uses AVX2
    constexpr std::array<const char *, 4> fallbacks{{"Prescott", "Barcelona", "Nehalem", "Sandybridge"}};
    if (!has_avx2 || std::find(fallbacks.begin(), fallbacks.end(), kernels) == fallbacks.end())
      return "";
    return has_avx512 ? "SkylakeX" : "Haswell";
  }

  void prepare_blas()
  {
    if (auto *const set_threads = loaded<void(int)>("openblas_set_num_threads"))
      set_threads(1);
    choose_kernels();
  }

  std::string loaded_blas()
  {
    std::string library;
    Dl_info info;
    if (dladdr(reinterpret_cast<void *>(&dgemm_), &info) && info.dli_fname)
      library = info.dli_fname;
    // In a program linked to shared libraries the address above may be that of a jump table: ask the loader.
    if (void *symbol = dlsym(RTLD_DEFAULT, "dgemm_"))
      if (dladdr(symbol, &info) && info.dli_fname)
        library = info.dli_fname;
    std::error_code error;
    const fs::path file = fs::canonical(library, error);
    return error ? library : file.string();
  }

  bool is_reference_blas(const std::string &library)
  {
    const fs::path path(library);
    const std::string file = path.filename().string();
    for (const char *name : {"libblas.so", "libblas-", "librefblas"})
      if (file.rfind(name, 0) == 0)
        // Debian's others have the same name in folders of theirs: openblas-pthread, blis-openmp, atlas, mkl
        return !is_of_faster_blas(path.parent_path().filename().string());
    return false;
  }

  std::string faster_blas_advice(const std::string &library)
  {
    const fs::path folder = fs::path(library).parent_path().parent_path();
    std::error_code ignored;
    for (const auto &entry : fs::directory_iterator(folder, ignored))
    {
      const std::string name = entry.path().filename().string();
      if (is_of_faster_blas(name) && fs::exists(entry.path() / "libblas.so.3", ignored))
        return name + " is installed beside it: choose it by update-alternatives --config libblas.so.3-" +
               folder.filename().string();
    }
    return "install libopenblas0-pthread";
  }
} // namespace vibrocontact

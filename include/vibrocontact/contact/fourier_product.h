#pragma once

#include <vibrocontact/numerics/wide_loops.h>

#include <functional>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Products with a matrix on a grid whose entries depend on the offsets between points alone, as cyclic convolutions by FFT
  /// on a grid that holds sources and targets side by side, so that nothing wraps around.
  class FourierProduct
  {
  public:
    /// points along x and y
    struct Size
    {
      unsigned int x, y;
    };

    /// @param row, column components; @param offset_x, offset_y of the target from the source, in points
    using Kernel = std::function<double(unsigned int row, unsigned int column, int offset_x, int offset_y)>;

    /// @param n_components at most three @param sources, targets rectangles of the grid; @param shift_x, shift_y first target less first source
    FourierProduct(const Kernel &kernel, unsigned int n_components, const Size &sources, const Size &targets,
                   int shift_x = 0, int shift_y = 0);
    ~FourierProduct();
    FourierProduct(const FourierProduct &) = delete;
    FourierProduct &operator=(const FourierProduct &) = delete;

    /// @param y, R the first target and the first source, component 0; @param line numbers from one line of the grid to the
    /// next, @param component from one component to the next
    void vmult(double *y, const double *R, std::size_t line, std::size_t component);

    const Size sources, targets;

  private:
    struct Plans;

    const unsigned int n_components, n_x, n_y;
    /// spectra have real and imaginary parts side by side
    std::size_t n_spectrum;
    AlignedVector forces, sums, spectrum;
    /// [n_components row + column], [column]
    std::vector<AlignedVector> kernels, force_spectra;
    std::unique_ptr<Plans> plans;
  };
} // namespace vibrocontact

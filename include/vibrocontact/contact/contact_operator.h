#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/scene/contact_grid.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  class FourierProduct;

  /// The constant linear part A of the discrete contact problem, y = A R + b (Delassus operator of the step).
  ///
  /// R: forces on body 1 (N, Tx, Ty) [N]; y: (gap [m], slip_x, slip_y [m/s]); contact_row() order. Without friction, or
  /// with friction along x alone, the rows that nothing moves along are left out: 1 or 2 components per point.
  class ContactOperator
  {
  public:
    virtual ~ContactOperator() = default;
    virtual unsigned int n_points() const = 0;
    /// rows per point: 1 (normal), 2 (and x) or 3 (and y)
    virtual unsigned int n_components() const { return 3; }
    /// y = A R; sources: the points where R is not zero (a hint, everything else is taken as zero). An
    /// operator may have rows of its own behind those of y; b then has them too, and solvers carry them
    /// along.
    virtual void vmult(DenseVector &y, const DenseVector &R,
                       const std::vector<unsigned int> &sources) const = 0;
    /// the same of a change of R, whose product single precision may give where it is faster: its rounding is 1e-7 of what the
    /// change moves, where hundreds of forces change a few times that
    virtual void vmult_change(DenseVector &y, const DenseVector &change,
                              const std::vector<unsigned int> &sources) const
    {
      vmult(y, change, sources);
    }
    /// the same as vmult, but y is only meaningful at the sources themselves; what iterative solvers call
    virtual void vmult_among(DenseVector &y, const DenseVector &R,
                             const std::vector<unsigned int> &sources) const
    {
      vmult(y, R, sources);
    }
    /// A restricted to some points, m times the components square, rows and columns (normal of all, x of all, y of all)
    virtual void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const = 0;
    /// mean of the diagonal entries of a component's own block
    virtual double mean_diagonal(unsigned int component) const = 0;
    /// the diagonal entry of a point, or the mean where points hardly differ
    virtual double diagonal(const unsigned int component, const unsigned int /*point*/) const
    {
      return mean_diagonal(component);
    }
    /// whether vmult costs much less than a dense product, so that iterative solvers pay for many points
    virtual bool fast_product() const = 0;
    /// Norm of I - A / mean_diagonal(0), of an operator with one component: by how much each step of Jacobi's iteration
    /// shrinks an error at least. 1 if nothing is known.
    virtual double jacobi_factor() const { return 1; }
  };

  /// A as a stored matrix: bodies from finite elements, or problems read from a file.
  class DenseContactOperator : public ContactOperator
  {
  public:
    /// @param matrix n times n_components square
    explicit DenseContactOperator(DenseMatrix matrix, unsigned int n_components = 3);
    unsigned int n_points() const override { return matrix.m() / components; }
    unsigned int n_components() const override { return components; }
    void vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const override;
    void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override;
    double mean_diagonal(unsigned int component) const override;
    double diagonal(const unsigned int component, const unsigned int point) const override
    {
      const unsigned int row = contact_row(n_points(), component, point);
      return matrix(row, row);
    }
    bool fast_product() const override { return false; }

  private:
    DenseMatrix matrix;
    unsigned int components;
  };

  /// A of two half-spaces on each other: translation invariant, nine kernels over the grid's offsets, so that memory grows
  /// with the grid and not with its square. Few sources are summed directly, many by FFT on a padded grid.
  class HalfSpaceOperator : public ContactOperator
  {
  public:
    /// @param upstream the tangential rows are sums of upstream[k] u(k spacings upstream) [-, 1/s]: {1} of displacements
    HalfSpaceOperator(const ContactGrid &grid, const HalfSpacePair &pair,
                      const std::vector<double> &upstream);
    ~HalfSpaceOperator() override;
    unsigned int n_points() const override { return grid.n_points(); }
    void vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const override;
    void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override;
    double mean_diagonal(unsigned int component) const override;
    bool fast_product() const override { return true; }
    /// A of all points as a matrix
    DenseMatrix matrix() const;
    /// FFT over the rectangle that just holds the sources
    void vmult_among(DenseVector &y, const DenseVector &R,
                     const std::vector<unsigned int> &sources) const override;

  private:
    std::unique_ptr<FourierProduct> fourier_product(unsigned int points_x, unsigned int points_y) const;

    double kernel(const unsigned int row, const unsigned int column, const int offset_x,
                  const int offset_y) const
    {
      return kernels[3 * row + column][(offset_y + grid.n_y - 1) * width + offset_x + grid.n_x - 1];
    }
    void vmult_direct(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const;

    ContactGrid grid;
    /// offsets along x, 2 n_x - 1
    unsigned int width;
    /// kernels[3 row + column][offset], offsets (target - source) from -(n - 1) to n - 1 in both directions
    std::vector<double> kernels[9];
    /// transforms of the kernels for the whole grid and for the last rectangle of vmult_among
    mutable std::unique_ptr<FourierProduct> whole, part;
  };

  /// Displacement compliance of two half-spaces on a grid as a dense matrix, 3 n square [m/N].
  DenseMatrix half_space_compliance(const ContactGrid &grid, const HalfSpacePair &pair);
} // namespace vibrocontact

#include <vibrocontact/bodies/patch_shapes.h>

#include <algorithm>

namespace vibrocontact
{
  PatchShapes patch_shapes(const DenseMatrix &trace, const double tolerance)
  {
    PatchShapes shapes;
    if (trace.n() == 0)
      return shapes;
    DenseMatrix decomposed(trace);
    decomposed.compute_svd();
    const unsigned int least = std::min(trace.m(), trace.n());
    unsigned int rank = 0;
    while (rank < least && decomposed.singular_value(rank) > tolerance * decomposed.singular_value(0))
      ++rank;
    const DenseMatrix &left = decomposed.get_svd_u();
    shapes.basis.reinit(trace.m(), rank);
    for (unsigned int k = 0; k < rank; ++k)
      std::copy_n(&left(0, k), trace.m(), &shapes.basis(0, k));
    shapes.amplitudes.reinit(rank, trace.n());
    if (rank > 0)
      shapes.basis.Tmmult(shapes.amplitudes, trace);
    return shapes;
  }
} // namespace vibrocontact

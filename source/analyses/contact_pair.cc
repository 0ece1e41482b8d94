#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/base/exceptions.h>

namespace vibrocontact
{
  DenseMatrix static_compliance(const ContactPair &pair)
  {
    DenseMatrix result = pair.residual_flexibility;
    if (pair.n_modes() == 0)
      return result;
    DenseMatrix scaled = pair.modal_trace, product(result.m(), result.m());
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      if (pair.omega[k] == 0)
        throw InputError(
            "Body '" + pair.labels[k].substr(0, pair.labels[k].find(':')) +
            "' is free to move: a static analysis cannot load it; hold one of its boundaries or put it on "
            "springs.");
      for (unsigned int i = 0; i < scaled.m(); ++i)
        scaled(i, k) /= pair.omega[k];
    }
    scaled.mTmult(product, scaled);
    result.add(1., product);
    return result;
  }
} // namespace vibrocontact

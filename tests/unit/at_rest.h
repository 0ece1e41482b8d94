#pragma once

#include <vibrocontact/bodies/body_in_contact.h>

/// Static answer of a body to forces on its rows, or of its gradient.
inline vibrocontact::DenseMatrix at_rest(vibrocontact::BodyInContact body, const bool gradient)
{
  if (gradient)
  {
    body.right = body.gradient;
    body.residual = body.residual_gradient;
  }
  vibrocontact::DenseMatrix result = sum_over_poles(body, static_weights(body));
  result.add(1., body.residual);
  return result;
}

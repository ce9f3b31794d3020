/* SPDX-License-Identifier: MIT
 *
 * Eqs 4.6-4.8 of the thesis over the verification measures of a cluster.
 */
struct verification {
    float sum_squares; /* sum of delta^2 over the neighbours */
    float sum;         /* sum of delta */
    float delta;       /* of the cluster itself */
    float unused;
};

/* Eq. 4.6; 0 where all clusters are empty. */
float delta_of(float area, float importance, float most_area)
{
    return most_area > 0.0 ? area / most_area * importance : 0.0;
}

/* delta - mean of the neighbours, weighted by itself (eq. 4.7); 0, which changes nothing, where
 * there is no neighbour or the sum of the weights vanishes. */
float imbalance(verification v)
{
    return v.sum > 0.0 ? v.delta - v.sum_squares / v.sum : 0.0;
}

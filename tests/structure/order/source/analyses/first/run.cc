#include <vibrocontact/analyses/second/steps.h>

"""The walk through the house: predict, correct, choose the mode, follow, regulate, check zones, decide."""

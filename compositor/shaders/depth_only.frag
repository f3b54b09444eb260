#version 450 core
// Real surfaces that virtual objects leave alone: they hide what is behind them, and nothing else.

void main() {}

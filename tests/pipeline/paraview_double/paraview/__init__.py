"""A stand-in for ParaView: see simple.py."""

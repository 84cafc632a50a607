"""The quarter vehicle of Kamp, Ultsch and Brembeck (2023): learn a suspension's missing forces from a ride."""

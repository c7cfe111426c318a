"""Which addresses belong to the public internet, whatever wraps them."""

from ipaddress import IPv4Address, IPv6Address, ip_address, ip_network

_UNICAST = ip_network("2000::/3")
"""All of IPv6 that is given out for use between networks."""

_NOT_PUBLIC = tuple(map(ip_network, (
    "192.88.99.0/24",  # gateways to 6to4
    "2001::/23",  # Teredo, benchmarks and other protocols' own
    "3fff::/20",  # documentation
)))
"""What counts as global in some versions of Python."""

_TRANSLATED = ip_network("64:ff9b::/96")
"""Addresses of IPv4 where a network speaks IPv6 alone; that of `64:ff9b:1::/48` is its own affair.
"""


def is_public(address: str) -> bool:
    """Tell whether an address belongs to the public internet.

    Raises
    ------
    ValueError
        If it is no address.
    """
    parsed = ip_address(address.partition("%")[0])
    if isinstance(parsed, IPv6Address):
        wrapped = _wrapped(parsed)
        if wrapped is not None:
            return is_public(str(wrapped))
        if parsed not in _UNICAST:
            return False
    return (parsed.is_global and not parsed.is_multicast
            and not any(parsed in network for network in _NOT_PUBLIC))


def _wrapped(address: IPv6Address) -> IPv4Address | None:
    """Return the IPv4 address that is meant by one of IPv6, if any."""
    if address in _TRANSLATED:
        return IPv4Address(int(address) & 0xFFFF_FFFF)
    return address.ipv4_mapped or address.sixtofour

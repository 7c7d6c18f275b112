#include "engine/simulator/gige/description.h"

namespace helical::gige {

std::string_view deviceDescription() {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<RegisterDescription ModelName="VirtualCamera" VendorName="Helical" StandardNameSpace="GEV"
    SchemaMajorVersion="1" SchemaMinorVersion="1" SchemaSubMinorVersion="0" MajorVersion="1" MinorVersion="0"
    SubMinorVersion="0" ToolTip="A camera of Helical's simulated field"
    ProductGuid="6d1a6ff4-7a63-4d1c-8a4b-2a9e3b4d5c01" VersionGuid="6d1a6ff4-7a63-4d1c-8a4b-2a9e3b4d5c02"
    xmlns="http://www.genicam.org/GenApi/Version_1_1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xsi:schemaLocation="http://www.genicam.org/GenApi/Version_1_1 GenApiSchema_Version_1_1.xsd">
<Category Name="Root"><pFeature>DeviceControl</pFeature><pFeature>ImageFormatControl</pFeature>
  <pFeature>AcquisitionControl</pFeature><pFeature>AnalogControl</pFeature><pFeature>ActionControl</pFeature>
  <pFeature>ChunkDataControl</pFeature>
  <pFeature>TransportLayerControl</pFeature></Category>
<Category Name="DeviceControl"><pFeature>DeviceVendorName</pFeature><pFeature>DeviceModelName</pFeature>
  <pFeature>DeviceVersion</pFeature><pFeature>DeviceManufacturerInfo</pFeature>
  <pFeature>DeviceSerialNumber</pFeature><pFeature>DeviceUserID</pFeature><pFeature>DeviceReset</pFeature>
  </Category>
<Category Name="ImageFormatControl"><pFeature>SensorWidth</pFeature><pFeature>SensorHeight</pFeature>
  <pFeature>WidthMax</pFeature><pFeature>HeightMax</pFeature><pFeature>Width</pFeature>
  <pFeature>Height</pFeature><pFeature>OffsetX</pFeature><pFeature>OffsetY</pFeature>
  <pFeature>PixelFormat</pFeature></Category>
<Category Name="AcquisitionControl"><pFeature>AcquisitionMode</pFeature><pFeature>AcquisitionStart</pFeature>
  <pFeature>AcquisitionStop</pFeature><pFeature>AcquisitionFrameRate</pFeature><pFeature>ExposureTime</pFeature>
  <pFeature>TriggerSelector</pFeature><pFeature>TriggerMode</pFeature><pFeature>TriggerSource</pFeature>
  <pFeature>TriggerActivation</pFeature><pFeature>TriggerSoftware</pFeature></Category>
<Category Name="AnalogControl"><pFeature>Gain</pFeature><pFeature>BalanceRatioSelector</pFeature>
  <pFeature>BalanceRatio</pFeature></Category>
<Category Name="ActionControl"><pFeature>ActionDeviceKey</pFeature><pFeature>ActionGroupKey</pFeature>
  <pFeature>ActionGroupMask</pFeature></Category>
<Category Name="ChunkDataControl"><pFeature>ChunkModeActive</pFeature><pFeature>ChunkSelector</pFeature>
  <pFeature>ChunkEnable</pFeature><pFeature>ChunkTimestamp</pFeature></Category>
<Category Name="TransportLayerControl"><pFeature>PayloadSize</pFeature><pFeature>TLParamsLocked</pFeature>
  <pFeature>GevHeartbeatTimeout</pFeature><pFeature>GevSCPSPacketSize</pFeature><pFeature>GevSCPD</pFeature>
  <pFeature>GevTimestampTickFrequency</pFeature><pFeature>PtpEnable</pFeature><pFeature>PtpStatus</pFeature>
  </Category>
<StringReg Name="DeviceVendorName"><Address>0x48</Address><Length>32</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort></StringReg>
<StringReg Name="DeviceModelName"><Address>0x68</Address><Length>32</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort></StringReg>
<StringReg Name="DeviceVersion"><Address>0x88</Address><Length>32</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort></StringReg>
<StringReg Name="DeviceManufacturerInfo"><Address>0xa8</Address><Length>48</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort></StringReg>
<StringReg Name="DeviceSerialNumber"><Address>0xd8</Address><Length>16</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort></StringReg>
<StringReg Name="DeviceUserID"><Address>0xe8</Address><Length>16</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort></StringReg>
<Command Name="DeviceReset"><pValue>DeviceResetReg</pValue><CommandValue>1</CommandValue></Command>
<IntReg Name="DeviceResetReg"><Address>0x208c</Address><Length>4</Length><AccessMode>WO</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="SensorWidth"><pValue>SensorWidthReg</pValue></Integer>
<IntReg Name="SensorWidthReg"><Address>0x2010</Address><Length>4</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>
<Integer Name="SensorHeight"><pValue>SensorHeightReg</pValue></Integer>
<IntReg Name="SensorHeightReg"><Address>0x2014</Address><Length>4</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>
<Integer Name="WidthMax"><pValue>SensorWidthReg</pValue></Integer>
<Integer Name="HeightMax"><pValue>SensorHeightReg</pValue></Integer>
<Integer Name="Width"><pValue>WidthReg</pValue><Min>16</Min><pMax>SensorWidthReg</pMax><Inc>2</Inc></Integer>
<IntReg Name="WidthReg"><Address>0x2000</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="Height"><pValue>HeightReg</pValue><Min>16</Min><pMax>SensorHeightReg</pMax><Inc>2</Inc></Integer>
<IntReg Name="HeightReg"><Address>0x2004</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="OffsetX"><pValue>OffsetXReg</pValue><Min>0</Min><pMax>OffsetXMax</pMax><Inc>2</Inc></Integer>
<IntReg Name="OffsetXReg"><Address>0x2008</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<IntSwissKnife Name="OffsetXMax"><pVariable Name="SENSOR">SensorWidthReg</pVariable>
  <pVariable Name="SIZE">WidthReg</pVariable><Formula>SENSOR - SIZE</Formula></IntSwissKnife>
<Integer Name="OffsetY"><pValue>OffsetYReg</pValue><Min>0</Min><pMax>OffsetYMax</pMax><Inc>2</Inc></Integer>
<IntReg Name="OffsetYReg"><Address>0x200c</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<IntSwissKnife Name="OffsetYMax"><pVariable Name="SENSOR">SensorHeightReg</pVariable>
  <pVariable Name="SIZE">HeightReg</pVariable><Formula>SENSOR - SIZE</Formula></IntSwissKnife>
<Enumeration Name="PixelFormat"><EnumEntry Name="BayerRG8"><Value>0x01080009</Value></EnumEntry>
  <EnumEntry Name="BayerGR8"><Value>0x01080008</Value></EnumEntry><EnumEntry Name="BayerGB8">
  <Value>0x0108000A</Value></EnumEntry><EnumEntry Name="BayerBG8"><Value>0x0108000B</Value></EnumEntry>
  <EnumEntry Name="Mono8"><Value>0x01080001</Value></EnumEntry><EnumEntry Name="RGB8"><Value>0x02180014</Value>
  </EnumEntry><EnumEntry Name="BGR8"><Value>0x02180015</Value></EnumEntry><pValue>PixelFormatReg</pValue>
  </Enumeration>
<IntReg Name="PixelFormatReg"><Address>0x2018</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Enumeration Name="AcquisitionMode"><EnumEntry Name="Continuous"><Value>0</Value></EnumEntry>
  <EnumEntry Name="SingleFrame"><Value>1</Value></EnumEntry><pValue>AcquisitionModeReg</pValue></Enumeration>
<IntReg Name="AcquisitionModeReg"><Address>0x2020</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>
<Command Name="AcquisitionStart"><pValue>AcquisitionReg</pValue><CommandValue>1</CommandValue></Command>
<Command Name="AcquisitionStop"><pValue>AcquisitionReg</pValue><CommandValue>0</CommandValue></Command>
<IntReg Name="AcquisitionReg"><Address>0x2024</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Float Name="AcquisitionFrameRate"><pValue>FrameRateReg</pValue><Min>1</Min><pMax>HighestFrameRateReg</pMax>
  <Unit>Hz</Unit></Float>
<FloatReg Name="FrameRateReg"><Address>0x2030</Address><Length>8</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Endianess>BigEndian</Endianess></FloatReg>
<FloatReg Name="HighestFrameRateReg"><Address>0x2038</Address><Length>8</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Endianess>BigEndian</Endianess></FloatReg>
<Float Name="ExposureTime"><pValue>ExposureTimeReg</pValue><Min>10</Min><Max>100000</Max><Unit>us</Unit></Float>
<FloatReg Name="ExposureTimeReg"><Address>0x2040</Address><Length>8</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Endianess>BigEndian</Endianess></FloatReg>
<Float Name="Gain"><pValue>GainReg</pValue><Min>0</Min><Max>24</Max><Unit>dB</Unit></Float>
<FloatReg Name="GainReg"><Address>0x2048</Address><Length>8</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Endianess>BigEndian</Endianess></FloatReg>
<Enumeration Name="BalanceRatioSelector"><EnumEntry Name="Red"><Value>0</Value></EnumEntry>
  <EnumEntry Name="Green"><Value>1</Value></EnumEntry><EnumEntry Name="Blue"><Value>2</Value></EnumEntry>
  <pValue>BalanceSelectorReg</pValue><pSelected>BalanceRatio</pSelected></Enumeration>
<IntReg Name="BalanceSelectorReg"><Address>0x2070</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Float Name="BalanceRatio"><pValue>BalanceRatioReg</pValue><Min>0.25</Min><Max>4</Max></Float>
<FloatReg Name="BalanceRatioReg"><Address>0x2050</Address><pIndex Offset="8">BalanceSelectorReg</pIndex>
  <Length>8</Length><AccessMode>RW</AccessMode><pPort>Device</pPort><Cachable>NoCache</Cachable>
  <Endianess>BigEndian</Endianess></FloatReg>
<Enumeration Name="TriggerSelector"><EnumEntry Name="FrameStart"><Value>0</Value></EnumEntry><Value>0</Value>
  </Enumeration>
<Enumeration Name="TriggerMode"><EnumEntry Name="Off"><Value>0</Value></EnumEntry><EnumEntry Name="On">
  <Value>1</Value></EnumEntry><pValue>TriggerModeReg</pValue></Enumeration>
<IntReg Name="TriggerModeReg"><Address>0x2074</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Enumeration Name="TriggerSource"><EnumEntry Name="Software"><Value>0</Value></EnumEntry>
  <EnumEntry Name="Line1"><Value>1</Value></EnumEntry><EnumEntry Name="Action1"><Value>2</Value></EnumEntry>
  <pValue>TriggerSourceReg</pValue></Enumeration>
<IntReg Name="TriggerSourceReg"><Address>0x2078</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Enumeration Name="TriggerActivation"><EnumEntry Name="RisingEdge"><Value>0</Value></EnumEntry><Value>0</Value>
  </Enumeration>
<Command Name="TriggerSoftware"><pValue>TriggerSoftwareReg</pValue><CommandValue>1</CommandValue></Command>
<IntReg Name="TriggerSoftwareReg"><Address>0x207c</Address><Length>4</Length><AccessMode>WO</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="ActionDeviceKey"><pValue>ActionDeviceKeyReg</pValue></Integer>
<IntReg Name="ActionDeviceKeyReg"><Address>0x2090</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="ActionGroupKey"><pValue>ActionGroupKeyReg</pValue></Integer>
<IntReg Name="ActionGroupKeyReg"><Address>0x2094</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="ActionGroupMask"><pValue>ActionGroupMaskReg</pValue></Integer>
<IntReg Name="ActionGroupMaskReg"><Address>0x2098</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Boolean Name="ChunkModeActive"><pValue>ChunkModeReg</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>
<IntReg Name="ChunkModeReg"><Address>0x209c</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Enumeration Name="ChunkSelector"><EnumEntry Name="Timestamp"><Value>0</Value></EnumEntry><Value>0</Value>
  </Enumeration>
<Boolean Name="ChunkEnable"><pValue>ChunkEnableReg</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>
<IntReg Name="ChunkEnableReg"><Address>0x20a0</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="ChunkTimestamp"><pValue>ChunkTimestampReg</pValue></Integer>
<IntReg Name="ChunkTimestampReg"><Address>0x0</Address><Length>8</Length><AccessMode>RO</AccessMode>
  <pPort>ChunkTimestampPort</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Port Name="ChunkTimestampPort"><ChunkID>2</ChunkID></Port>
<Integer Name="PayloadSize"><pValue>PayloadSizeReg</pValue></Integer>
<IntReg Name="PayloadSizeReg"><Address>0x201c</Address><Length>4</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="TLParamsLocked"><pValue>TransportLockedReg</pValue><Min>0</Min><Max>1</Max></Integer>
<IntReg Name="TransportLockedReg"><Address>0x2080</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="GevHeartbeatTimeout"><pValue>HeartbeatTimeoutReg</pValue><Min>500</Min><Max>60000</Max></Integer>
<IntReg Name="HeartbeatTimeoutReg"><Address>0x938</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="GevSCPSPacketSize"><pValue>PacketSizeReg</pValue><Min>220</Min><Max>16384</Max><Inc>4</Inc>
  </Integer>
<MaskedIntReg Name="PacketSizeReg"><Address>0xd04</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><LSB>31</LSB><MSB>16</MSB><Sign>Unsigned</Sign>
  <Endianess>BigEndian</Endianess></MaskedIntReg>
<Integer Name="GevSCPD"><pValue>PacketDelayReg</pValue><Min>0</Min><Max>1000000</Max></Integer>
<IntReg Name="PacketDelayReg"><Address>0xd08</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Integer Name="GevTimestampTickFrequency"><pValue>TickFrequencyReg</pValue></Integer>
<IntReg Name="TickFrequencyReg"><Address>0x940</Address><Length>4</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>
<Boolean Name="PtpEnable"><pValue>PtpEnableReg</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>
<IntReg Name="PtpEnableReg"><Address>0x2084</Address><Length>4</Length><AccessMode>RW</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Enumeration Name="PtpStatus"><EnumEntry Name="Disabled"><Value>0</Value></EnumEntry><EnumEntry Name="Slave">
  <Value>1</Value></EnumEntry><pValue>PtpStatusReg</pValue></Enumeration>
<IntReg Name="PtpStatusReg"><Address>0x2088</Address><Length>4</Length><AccessMode>RO</AccessMode>
  <pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
  </IntReg>
<Port Name="Device"/>
</RegisterDescription>
)";
}

}  // namespace helical::gige
